// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/child_process.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <new>

namespace hogel::core {
namespace {

constexpr ChildLimits limits{.cpu_seconds = 1, .patience = std::chrono::seconds(1)};

int read_int(ChildProcess& child) {
    int value = 0;
    child.read(&value, sizeof value);
    return value;
}

void write_int(int pipe, int value) { ChildProcess::write(pipe, &value, sizeof value); }

// How a child that does this work fails.
ChildFailure::Kind failure_of(const std::function<void(int)>& work) {
    try {
        with_child(limits, work, read_int);
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
    EXPECT_EQ(with_child(limits, stuck_first, read_int), 1);
    children = 0;
    EXPECT_EQ(failure_of([&](int) {
                  ++children;
                  ::pause();
              }),
              ChildFailure::Kind::stuck);
    EXPECT_EQ(children, 2);
    ::munmap(shared, sizeof(std::atomic<int>));
}

}  // namespace
}  // namespace hogel::core
