// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

#include "hogel/core/parallel.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

// Sanitizers have allocators of their own, which end the process where memory is short, and whose locks a fork leaves
// as they are.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HOGEL_OWN_ALLOCATOR
#endif

/// How a child process ends that never sends anything.
ChildFailure::Kind failure(const ChildLimits& limits, const std::function<void(int)>& work) {
    ChildProcess child(limits, work);
    char byte = 0;
    try {
        child.read(&byte, 1);
    } catch (const ChildFailure& error) {
        EXPECT_NE(std::string(error.what()), "");
        return error.kind();
    }
    ADD_FAILURE() << "it sent " << byte;
    return {};
}

volatile unsigned endless = 0;

TEST(ChildProcess, what_it_writes_arrives_whole) {
    std::vector<std::uint32_t> sent(3'000'000);
    for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::uint32_t>(i * 2654435761u);
    ChildProcess child({}, [&](int pipe) { ChildProcess::write(pipe, sent.data(), sent.size() * sizeof sent[0]); });
    std::vector<std::uint32_t> received(sent.size());
    child.read(received.data(), received.size() * sizeof received[0]);
    EXPECT_EQ(received, sent);
}

TEST(ChildProcess, a_crash_is_an_exception) {
    EXPECT_EQ(failure({}, [](int) { std::abort(); }), ChildFailure::Kind::crashed);
    EXPECT_EQ(failure({}, [](int) { raise(SIGSEGV); }), ChildFailure::Kind::crashed);
    EXPECT_EQ(failure({}, [](int) {}), ChildFailure::Kind::crashed);
}

#ifdef HOGEL_OWN_ALLOCATOR
TEST(ChildProcess, memory_is_limited) {
    const auto allocates = [](std::size_t bytes) {
        ChildProcess child({.memory = 100 << 20}, [&](int pipe) {
            char answer = 'y';
            try {
                ::operator delete(::operator new(bytes));
            } catch (const std::bad_alloc&) {
                answer = 'n';
            }
            ChildProcess::write(pipe, &answer, 1);
        });
        char answer = 0;
        child.read(&answer, 1);
        return answer == 'y';
    };
    EXPECT_TRUE(allocates(80 << 20));
    EXPECT_FALSE(allocates(120 << 20));
}
#endif

TEST(ChildProcess, time_is_limited) {
    const auto spin = [](int) {
        for (;;) endless = endless + 1;
    };
    EXPECT_EQ(failure({.cpu_seconds = 1}, spin), ChildFailure::Kind::time);
}

TEST(ChildProcess, one_that_waits_for_ever_is_ended) {
    const auto wait = [](int) {
        for (;;) pause();
    };
    EXPECT_EQ(failure({.patience = std::chrono::seconds(1)}, wait), ChildFailure::Kind::stuck);
}

TEST(ChildProcess, a_stop_ends_it_within_a_second) {
    using Clock = std::chrono::steady_clock;
    std::stop_source stop;
    const StopScope scope{Progress(stop.get_token())};
    Clock::time_point asked;
    {
        ChildProcess child({}, [](int) {
            for (;;) endless = endless + 1;
        });
        std::jthread stopper([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            asked = Clock::now();
            stop.request_stop();
        });
        char byte = 0;
        try {
            child.read(&byte, 1);
            ADD_FAILURE() << "it sent something";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
    }
    EXPECT_LT(Clock::now() - asked, std::chrono::seconds(1));
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a process is left";
}

TEST(ChildProcess, it_has_no_file_of_its_parent) {
    const int low = open("/dev/null", O_RDONLY);
    const int file = fcntl(low, F_DUPFD, 100);  // the child gives low numbers to files of its own
    close(low);
    ChildProcess child({}, [&](int pipe) {
        const char answer = fcntl(file, F_GETFD) == -1 ? 'n' : 'y';
        ChildProcess::write(pipe, &answer, 1);
    });
    char answer = 0;
    child.read(&answer, 1);
    EXPECT_EQ(answer, 'n');
    close(file);
}

#ifdef HOGEL_OWN_ALLOCATOR
// Threads that allocate all the time, as parallel loops do, while others start children that allocate.
TEST(ChildProcess, it_works_while_other_threads_do) {
    std::atomic<bool> done = false;
    std::vector<std::jthread> busy;
    for (int i = 0; i < 3; ++i)
        busy.emplace_back([&] {
            while (!done) std::vector<std::vector<char>>(100, std::vector<char>(1000));
        });
    parallel_for(4, [&](std::size_t) {
        for (int i = 0; i < 50; ++i) {
            ChildProcess child({}, [](int pipe) {
                const std::string text(1000, 'x');
                ChildProcess::write(pipe, text.data(), text.size());
            });
            std::string text(1000, ' ');
            child.read(text.data(), text.size());
            EXPECT_EQ(text, std::string(1000, 'x'));
        }
    });
    done = true;
}
#endif

}  // namespace
}  // namespace hogel::core
