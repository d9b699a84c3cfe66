// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/child_process.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>
#include <memory>
#include <new>
#include <thread>

namespace hogel::core {
namespace {

constexpr ChildLimits limits{.cpu_seconds = 1};

int read_int(ChildProcess& child) {
    int value = 0;
    child.read(&value, sizeof value);
    return value;
}

void write_int(int pipe, int value) { ChildProcess::write(pipe, &value, sizeof value); }

// Returns the kind of failure of a child with this work.
ChildFailure::Kind failure_of(const std::function<void(int)>& work, const ChildLimits& of_child = limits) {
    try {
        with_child(of_child, work, read_int);
    } catch (const ChildFailure& failure) {
        return failure.kind();
    }
    throw std::runtime_error("did not fail");
}

TEST(ChildProcess, sends_its_result_and_changes_nothing_here) {
    int here = 1;
    const int there = with_child(
        limits,
        [&](int pipe) {
            here = 2;
            write_int(pipe, here);
        },
        read_int);
    EXPECT_EQ(there, 2);
    EXPECT_EQ(here, 1);
}

TEST(ChildProcess, failures_are_told_apart) {
    EXPECT_EQ(failure_of([](int) { std::raise(SIGSEGV); }), ChildFailure::Kind::crashed);
    EXPECT_EQ(failure_of([](int) {}), ChildFailure::Kind::crashed);
    EXPECT_EQ(failure_of([](int) {
                  for (std::atomic<int> i = 0;;) ++i;
              }),
              ChildFailure::Kind::time);
}

TEST(ChildProcess, a_stuck_one_is_tried_again_once) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the thread sanitizer has a thread in the child that uses processor time";
#endif
    void* const shared =
        ::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(shared, MAP_FAILED);
    auto& children = *new (shared) std::atomic<int>(0);
    const auto stuck_first = [&](int pipe) {
        const int before = children++;
        if (before == 0) ::pause();
        write_int(pipe, before);
    };
    constexpr ChildLimits impatient{.cpu_seconds = 1, .patience = std::chrono::seconds(1)};
    EXPECT_EQ(with_child(impatient, stuck_first, read_int), 1);
    children = 0;
    EXPECT_EQ(failure_of(
                  [&](int) {
                      ++children;
                      ::pause();
                  },
                  impatient),
              ChildFailure::Kind::stuck);
    EXPECT_EQ(children, 2);
    ::munmap(shared, sizeof(std::atomic<int>));
}

TEST(ChildProcess, one_that_serves_answers_requests_of_any_thread_until_the_pipe_is_closed) {
    std::unique_ptr<ChildProcess> child;
    std::jthread([&] {
        child = std::make_unique<ChildProcess>(ChildLimits{.cpu_seconds = 1, .serves = true}, [](int pipe) {
            for (int number = 0; ChildProcess::receive(pipe, &number, sizeof number);) {
                ChildProcess::renew_limits({.memory = std::uint64_t{1} << 28, .cpu_seconds = 1});
                write_int(pipe, 2 * number);
            }
        });
    }).join();  // a child ends with the thread that started it, unless `serves`
    for (const int number : {1, 20, 300}) {
        child->send(&number, sizeof number);
        EXPECT_EQ(read_int(*child), 2 * number);
    }
    child.reset();
}

TEST(ChildProcess, limits_are_renewed_from_what_is_used) {
    const auto use_a_second_and_more = [] {
        for (const std::clock_t begin = std::clock(); std::clock() - begin < 6 * CLOCKS_PER_SEC / 5;) {
        }
    };
    EXPECT_EQ(with_child(
                  limits,
                  [&](int pipe) {
                      for (int i = 0; i < 2; ++i) {
                          ChildProcess::renew_limits({.cpu_seconds = 1});
                          use_a_second_and_more();
                      }
                      write_int(pipe, 7);
                  },
                  read_int),
              7);
    EXPECT_EQ(failure_of([&](int pipe) {
                  ChildProcess::renew_limits({.cpu_seconds = 0});
                  for (int i = 0; i < 2; ++i) use_a_second_and_more();
                  write_int(pipe, 7);
              }),
              ChildFailure::Kind::time);
}

}  // namespace
}  // namespace hogel::core
