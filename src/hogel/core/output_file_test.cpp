// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/output_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "hogel/error.h"

namespace hogel::core {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
  protected:
    OutputFileTest() { fs::create_directories(directory_); }
    ~OutputFileTest() override { fs::remove_all(directory_); }

    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
    }
    static std::string text_of(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write_text(const fs::path& path, const std::string& text) {
        write_file(path, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
    }
    static std::string refusal(const fs::path& path) {
        try {
            write_text(path, "x");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cannot_write);
            return error.what();
        }
        return "";
    }

    fs::path directory_ = fs::path(testing::TempDir()) / ("hogel_output_" + std::to_string(::getpid()));
};

TEST_F(OutputFileTest, replaces_a_file_and_leaves_nothing_else) {
    write_text(directory_ / "a.txt", "first, and longer");
    write_text(directory_ / "a.txt", "second");
    EXPECT_EQ(text_of(directory_ / "a.txt"), "second");
    EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, without_commit_the_old_file_stays) {
    write_text(directory_ / "a.txt", "old");
    {
        OutputFile file(directory_ / "a.txt");
        std::ofstream(file.temporary()) << "half of the ne";
        EXPECT_EQ(files(), 2u);
    }
    EXPECT_EQ(text_of(directory_ / "a.txt"), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, follows_a_symbolic_link) {
    write_text(directory_ / "a.txt", "old");
    fs::create_symlink("a.txt", directory_ / "link");
    write_text(directory_ / "link", "new");
    EXPECT_TRUE(fs::is_symlink(directory_ / "link"));
    EXPECT_EQ(text_of(directory_ / "a.txt"), "new");
}

TEST_F(OutputFileTest, errors_say_what_is_in_the_way) {
    EXPECT_NE(refusal(directory_).find("is a directory"), std::string::npos);
    EXPECT_NE(refusal(directory_ / "none" / "a.txt").find("there is no directory"), std::string::npos);
    EXPECT_NE(refusal("/dev/null").find("not a plain file"), std::string::npos);
    EXPECT_NE(refusal(directory_ / "a" / "").find("no file name"), std::string::npos);
    EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFileTest, temporaries_of_killed_processes_are_removed_by_the_next) {
    const fs::path target = directory_ / "a.bin";
    const pid_t child = fork();
    if (child == 0) {
        const OutputFile file(target);
        kill(getpid(), SIGKILL);
    }
    waitpid(child, nullptr, 0);
    EXPECT_EQ(files(), 1u);
    std::ofstream(directory_ / fmt::format(".a.bin.{}.7.tmp.txt", child)) << "another's";
    std::ofstream(directory_ / fmt::format(".b.bin.{}.7.tmp", child)) << "of another target";
    {
        const OutputFile other(directory_ / "c.bin");
        EXPECT_EQ(files(), 4u);
        const OutputFile file(target);
        EXPECT_EQ(files(), 4u);
        EXPECT_TRUE(fs::exists(other.temporary()));
        EXPECT_TRUE(fs::exists(file.temporary()));
        // Two that are written at the same time are not stale.
        const OutputFile twin(target);
        EXPECT_TRUE(fs::exists(file.temporary()));
        EXPECT_NE(twin.temporary(), file.temporary());
    }
    EXPECT_EQ(files(), 2u);
}

TEST_F(OutputFileTest, a_full_disk_leaves_the_old_file) {
    write_text(directory_ / "a.txt", "old");
    const pid_t child = fork();
    if (child == 0) {
        // A limit on the size of files makes writes fail as a full disk does.
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        setrlimit(RLIMIT_FSIZE, &limit);
        int status = 1;
        try {
            write_text(directory_ / "a.txt", std::string(100000, 'x'));
        } catch (const Error& error) {
            status = error.code() == ErrorCode::cannot_write ? 0 : 2;
        }
        _exit(status);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(text_of(directory_ / "a.txt"), "old");
    EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace hogel::core
