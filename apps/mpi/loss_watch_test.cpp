// SPDX-License-Identifier: Apache-2.0
#include "mpi/loss_watch.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <future>

namespace hogel::mpi {
namespace {

// Starts a process that waits until it is killed.
pid_t waiting_process() {
    const pid_t process = fork();
    if (process == 0)
        for (;;) pause();
    return process;
}

void end(pid_t process) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
}

TEST(LossWatch, names_the_rank_whose_process_was_killed) {
    const std::array<RankProcess, 2> others{{{1, waiting_process()}, {4, waiting_process()}}};
    std::promise<std::size_t> lost;
    const LossWatch watch(others, [&](const RankProcess& rank) { lost.set_value(rank.rank); });
    end(others[1].process);
    std::future<std::size_t> answer = lost.get_future();
    const bool reported = answer.wait_for(std::chrono::seconds(60)) == std::future_status::ready;
    end(others[0].process);
    ASSERT_TRUE(reported);
    EXPECT_EQ(answer.get(), 4u);
}

TEST(LossWatch, says_nothing_once_it_has_ended) {
    const std::array<RankProcess, 1> others{{{1, waiting_process()}}};
    std::atomic<bool> called = false;
    {
        const LossWatch watch(others, [&](const RankProcess&) { called = true; });
    }
    end(others[0].process);
    EXPECT_FALSE(called);
}

}  // namespace
}  // namespace hogel::mpi
