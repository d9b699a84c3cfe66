// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "hogel/error.h"

namespace hogel::work {
namespace {

class JournalTest : public testing::Test {
  protected:
    JournalTest() { std::filesystem::remove(path_); }
    ~JournalTest() override { std::filesystem::remove(path_); }

    Journal open(std::vector<std::string> work) const {
        return {path_, std::move(work), [] {}};
    }
    std::string text() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("hogel_journal_" + std::to_string(::getpid()));
};

TEST_F(JournalTest, lists_the_parts_done_in_earlier_runs) {
    {
        Journal journal = open({"scene pumpkin", "two\nlines"});
        EXPECT_FALSE(journal.begun());
        journal.begin();
        journal.note({0, 1, 2});
        journal.note({7});
        EXPECT_FALSE(journal.was_done({7}));  // done in this run, not before
    }
    Journal journal = open({"scene pumpkin", "two\nlines"});
    EXPECT_TRUE(journal.begun());
    EXPECT_TRUE(journal.was_done({0, 1, 2}));
    EXPECT_TRUE(journal.was_done({7}));
    EXPECT_FALSE(journal.was_done({0, 1}));
    journal.remove();
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(JournalTest, belongs_to_work_of_long_lines) {
    const std::vector<std::string> work{std::string(50'000, 'a'), "", std::string(300'000, 'b')};
    open(work).begin();
    EXPECT_TRUE(open(work).begun());
}

TEST_F(JournalTest, flushes_results_before_recording_them_as_done) {
    std::string seen = "never";
    {
        Journal journal(path_, {"work"}, [&] { seen = text(); });
        journal.begin();
        journal.note({1});
    }
    const std::string record = CheckpointRecord{{1}, {}}.encoded();
    EXPECT_EQ(seen.find(record), std::string::npos);
    EXPECT_NE(seen, "never");
    EXPECT_NE(text().find(record), std::string::npos);
}

TEST_F(JournalTest, names_the_first_difference_of_other_work) {
    open({"scene pumpkin", "hogels 64x64"}).begin();
    for (const auto& other : {std::vector<std::string>{"scene pumpkin", "hogels 32x32"}, {"scene pumpkin"}}) try {
            open(other);
            ADD_FAILURE() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("'hogels 64x64'"), std::string::npos) << error.what();
        }
}

TEST_F(JournalTest, is_open_only_once_at_a_time) {
    const Journal first = open({"work"});
    EXPECT_THROW(open({"work"}), Error);
}

TEST_F(JournalTest, damage_never_makes_a_part_count_as_done) {
    {
        Journal journal = open({"work"});
        journal.begin();
        for (std::uint64_t i = 0; i < 8; ++i) journal.note({i, 10 * i});
    }
    const std::string good = text();
    const auto check = [&](const std::string& damaged) {
        write(damaged);
        try {
            Journal journal = open({"work"});
            for (std::uint64_t i = 0; i < 100; ++i)
                if (journal.was_done({i, 10 * i})) {
                    ASSERT_LT(i, 8u);
                    ASSERT_TRUE(journal.begun());
                }
            // Parts added after the damage are recorded.
            if (!journal.begun()) journal.begin();
            journal.note({1000});
        } catch (const Error& error) {
            ASSERT_TRUE(error.code() == ErrorCode::bad_input || error.code() == ErrorCode::usage) << error.what();
            return;
        }
        ASSERT_TRUE(open({"work"}).was_done({1000}));
    };
    for (std::size_t length = 0; length < good.size(); ++length) check(good.substr(0, length));
    for (std::size_t i = 0; i < good.size(); ++i)
        for (const char flip : {1, 64}) {
            std::string damaged = good;
            damaged[i] = static_cast<char>(damaged[i] ^ flip);
            check(damaged);
        }
}

// A rank without the journal sends its records after its results.
TEST_F(JournalTest, keeps_the_records_of_another_process) {
    {
        Journal kept = open({"work"});
        kept.begin();
        kept.note({1, 2});
        bool flushed = false;
        Journal other(
            kept.before(), [&] { flushed = true; },
            [&](const std::string& lines) {
                EXPECT_TRUE(flushed);
                kept.take(lines);
            });
        EXPECT_TRUE(other.begun());
        other.note({3, 4});
        other.write();
        EXPECT_TRUE(flushed);
    }
    const Journal again = open({"work"});
    EXPECT_TRUE(again.was_done({1, 2}));
    EXPECT_TRUE(again.was_done({3, 4}));
    EXPECT_FALSE(again.was_done({3, 5}));
    const Journal of_other(
        again.before(), [] {}, [](const std::string&) { FAIL() << "nothing was done"; });
    EXPECT_TRUE(of_other.was_done({3, 4}));
}

}  // namespace
}  // namespace hogel::work
