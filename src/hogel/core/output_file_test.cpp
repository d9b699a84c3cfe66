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
#include <stop_token>
#include <string>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
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

TEST_F(OutputFileTest, a_stop_while_a_file_is_written_leaves_the_one_that_was_there) {
    write_text(directory_ / "a", "before");
    std::stop_source stop;
    const StopScope scope{Progress(stop.get_token())};
    stop.request_stop();
    EXPECT_TRUE(is_cancelled([&] { write_text(directory_ / "a", "after"); }));
    EXPECT_EQ(text_of(directory_ / "a"), "before");
    EXPECT_EQ(files(), 1u);
}

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

TEST_F(OutputFileTest, an_unnamed_file_holds_what_is_written_and_never_shows) {
    RawFile file(directory_, RawFile::Mode::unnamed, "scratch");
    file.write(3, "abc", 3);
    char text[3];
    file.read(3, text, 3);
    EXPECT_EQ(std::string(text, 3), "abc");
    EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFileTest, a_set_appears_when_all_of_it_is_complete) {
    write_text(directory_ / "a.txt", "old");
    write_text(directory_ / "other.txt", "other");
    fs::create_symlink("other.txt", directory_ / "link.txt");
    write_set(directory_, [&](const fs::path& temporary) {
        for (const char* name : {"a.txt", "b.txt", "link.txt"}) write_text(temporary / name, "new");
        EXPECT_EQ(text_of(directory_ / "a.txt"), "old");
        EXPECT_FALSE(fs::exists(directory_ / "b.txt"));
    });
    for (const char* name : {"a.txt", "b.txt", "other.txt"}) EXPECT_EQ(text_of(directory_ / name), "new") << name;
    EXPECT_TRUE(fs::is_symlink(directory_ / "link.txt"));
    EXPECT_EQ(files(), 4u);
}

TEST_F(OutputFileTest, a_set_that_fails_leaves_the_old_files_and_names_the_folder) {
    write_text(directory_ / "a.txt", "old");
    std::string message;
    try {
        write_set(directory_, [&](const fs::path& temporary) {
            write_text(temporary / "a.txt", "new");
            write_text(temporary / "none" / "b.txt", "new");
        });
    } catch (const Error& error) {
        message = error.what();
    }
    EXPECT_NE(message.find((directory_ / "none" / "b.txt").string()), std::string::npos) << message;
    EXPECT_EQ(text_of(directory_ / "a.txt"), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, a_set_moves_nothing_when_one_of_its_files_is_in_the_way) {
    fs::create_directory(directory_ / "b.txt");
    EXPECT_THROW(write_set(directory_,
                           [&](const fs::path& temporary) {
                               for (const char* name : {"a.txt", "b.txt"}) write_text(temporary / name, "new");
                           }),
                 Error);
    EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, a_killed_process_leaves_no_part_of_a_set_and_the_next_removes_the_rest) {
    const pid_t child = fork();
    if (child == 0)
        write_set(directory_, [](const fs::path& temporary) {
            write_text(temporary / "a.txt", "new");
            kill(getpid(), SIGKILL);
        });
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(fs::exists(directory_ / "a.txt"));
    EXPECT_EQ(files(), 1u);
    write_set(directory_, [&](const fs::path& temporary) {
        EXPECT_EQ(files(), 1u);
        // One that is written at the same time is not stale.
        write_set(directory_, [&](const fs::path&) { EXPECT_TRUE(fs::exists(temporary)); });
    });
    EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace hogel::core
