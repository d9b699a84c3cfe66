// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/result_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "hogel/error.h"
#include "hogel/resume.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::work {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> work{"squares", "option n 100"};

void expect_error(ErrorCode code, const std::string& words, const auto& call) {
    try {
        call();
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

class ResultLogs : public testing::Test {
  protected:
    ResultLogs() : file_(fs::temp_directory_path() / ("hogel_results_" + std::to_string(::getpid()) + ".part")) {}
    ~ResultLogs() override { fs::remove(file_); }

    struct Run {
        std::vector<std::uint64_t> merged;
        std::size_t computed = 0;
    };

    // Runs two loops, the second with n results; fails at the merge of one result of the second loop.
    Run squares(std::size_t n, std::size_t interrupted_at = SIZE_MAX) {
        Run run;
        std::atomic<std::size_t> computed = 0;
        ResumeScope scope(file_, work);
        const auto loop = [&](std::size_t count, std::size_t stop) {
            ordered_reduce<std::uint64_t>(
                count, 4, {},
                [&](std::size_t i) {
                    ++computed;
                    return std::uint64_t{i} * i;
                },
                [&](std::size_t i, std::uint64_t& square) {
                    if (i == stop) throw Error(ErrorCode::cancelled, "stopped");
                    EXPECT_EQ(square, i * i);
                    run.merged.push_back(square);
                });
        };
        try {
            loop(10, SIZE_MAX);
            loop(n, interrupted_at);
        } catch (const Error&) {
        }
        run.computed = computed;
        return run;
    }

    fs::path file_;
};

TEST_F(ResultLogs, go_on_where_work_was_interrupted) {
    const Run first = squares(100, 60);
    EXPECT_EQ(first.merged.size(), 70u);
    const Run second = squares(100);
    EXPECT_EQ(second.computed, 40u);
    EXPECT_EQ(second.merged.size(), 110u);
    EXPECT_EQ(squares(100).computed, 0u);
}

TEST_F(ResultLogs, take_nothing_from_a_damaged_record_on) {
    squares(100);
    const auto whole = fs::file_size(file_);
    fs::resize_file(file_, whole - 1);
    EXPECT_EQ(squares(100).computed, 1u);
    EXPECT_EQ(fs::file_size(file_), whole);
    {
        std::fstream bytes(file_, std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekp(-50 * 56 + 52, std::ios::end);  // in the bytes of the 50th result from the end
        bytes.put('!');
    }
    EXPECT_EQ(squares(100).computed, 50u);
    EXPECT_EQ(squares(100).computed, 0u);
}

TEST_F(ResultLogs, of_a_loop_of_another_length_are_forgotten) {
    squares(100);
    const Run other = squares(30);
    EXPECT_EQ(other.computed, 30u);
    EXPECT_EQ(other.merged.size(), 40u);
}

TEST_F(ResultLogs, of_other_work_are_refused) {
    squares(100, 60);
    expect_error(ErrorCode::usage, "begun with 'option n 100', not 'option n 7'", [&] {
        ResumeScope(file_, {"squares", "option n 7"});
    });
    expect_error(ErrorCode::usage, "begun with 'option n 100'", [&] { ResumeScope(file_, {"squares"}); });
    std::ofstream(file_) << "something else";
    expect_error(ErrorCode::bad_input, "not a checkpoint of hogel", [&] { ResumeScope(file_, work); });
    EXPECT_TRUE(fs::exists(file_));
}

TEST_F(ResultLogs, of_one_process_are_written_by_no_other) {
    const ResumeScope scope(file_, work);
    expect_error(ErrorCode::cannot_write, "another process", [&] { ResumeScope(file_, work); });
    expect_error(ErrorCode::usage, "only one can be active at a time",
                 [&] { ResumeScope(file_.string() + "2", work); });
    EXPECT_FALSE(fs::exists(file_.string() + "2"));
}

TEST_F(ResultLogs, leave_no_file_where_nothing_was_kept_or_all_is_done) {
    { const ResumeScope scope(file_, work); }
    EXPECT_FALSE(fs::exists(file_));
    squares(100, 60);
    EXPECT_TRUE(fs::exists(file_));
    ResumeScope scope(file_, work);
    scope.complete();
    EXPECT_FALSE(fs::exists(file_));
}

}  // namespace
}  // namespace hogel::work
