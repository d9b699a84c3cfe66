// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <thread>

#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
#include "hogel/progress.h"

namespace hogel::core {
namespace {

TEST(Program, IsFoundByPathAndSaysHowItEnded) {
    EXPECT_EQ(find_program("no-such-program-anywhere"), "");
    const std::string shell = find_program("sh");
    ASSERT_NE(shell, "");
    EXPECT_TRUE(run_program({shell, "-c", "exit 0"}));
    EXPECT_FALSE(run_program({shell, "-c", "exit 3"}));
    EXPECT_FALSE(run_program({shell, "-c", "kill -9 $$"}));
    EXPECT_FALSE(run_program({"/no/such/program"}));
}

// Returns the process id that a process has written into a file; 0 before that.
pid_t process_in(const std::filesystem::path& file) {
    pid_t process = 0;
    std::ifstream(file) >> process;
    return process;
}

TEST(Program, EndsWhenTheWorkIsStopped) {
    const std::filesystem::path begun = std::filesystem::path(testing::TempDir()) / fmt::format("begun_{}", getpid());
    std::stop_source stop;
    const Progress progress(stop.get_token());
    const StopScope scope(progress);
    std::jthread other([&](const std::stop_token& ended) {
        while (process_in(begun) == 0 && !ended.stop_requested())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stop.request_stop();
    });
    // `exec` keeps the process id of the shell.
    const std::string line = fmt::format("echo $$ > '{}'; exec sleep 60", begun.string());
    EXPECT_TRUE(is_cancelled([&] { run_program({find_program("sh"), "-c", line}); }));
    other.request_stop();
    other.join();
    const pid_t process = process_in(begun);
    std::filesystem::remove(begun);
    ASSERT_GT(process, 0);
    EXPECT_EQ(kill(process, 0), -1) << "the program runs on";
    EXPECT_EQ(errno, ESRCH);
}

}  // namespace
}  // namespace hogel::core
