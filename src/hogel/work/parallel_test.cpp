// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "hogel/core/stop_scope.h"
#include "hogel/core/test_errors.h"
#include "hogel/core/test_stop.h"

namespace hogel::work {
namespace {

using std::chrono::milliseconds;

TEST(ParallelFor, calls_the_body_once_for_every_index) {
    for (const std::size_t n : {0, 1, 2, 1000}) {
        std::vector<std::atomic<int>> calls(n);
        parallel_for(n, [&](std::size_t i) { ++calls[i]; });
        for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelFor, rethrows_what_a_body_throws) {
    EXPECT_THROW(parallel_for(100,
                              [](std::size_t i) {
                                  if (i == 57) throw Error(ErrorCode::bad_input, "57");
                              }),
                 Error);
}

TEST(ParallelFor, inside_a_loop_that_has_failed_never_returns_with_bodies_left_out) {
    std::atomic<bool> failed{false};
    EXPECT_THROW(parallel_for(64,
                              [&](std::size_t i) {
                                  if (i == 0) {
                                      failed = true;
                                      throw Error(ErrorCode::bad_input, "0");
                                  }
                                  while (!failed && i == 32) std::this_thread::yield();
                                  std::this_thread::sleep_for(milliseconds(2));
                                  std::atomic<std::size_t> ran{0};
                                  parallel_for(50, [&](std::size_t) { ++ran; });
                                  EXPECT_EQ(ran, 50u);
                              }),
                 Error);
}

TEST(LocalOrderedReduce, merges_in_order_with_few_results_alive) {
    std::atomic<int> alive{0}, max_alive{0};
    std::vector<std::size_t> merged;
    local_ordered_reduce<std::size_t>(
        100, 7,
        [&](std::size_t i) {
            max_alive = std::max<int>(max_alive, ++alive);
            return i * i;
        },
        [&](std::size_t i, std::size_t& result) {
            EXPECT_EQ(result, i * i);
            merged.push_back(i);
            --alive;
        });
    ASSERT_EQ(merged.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(merged[i], i);
    EXPECT_LE(max_alive, 7);
}

TEST(StopScope, ends_a_long_loop_at_once) {
    core::StoppedWork work(20 * thread_count());
    const core::StopScope scope(work.progress());
    EXPECT_TRUE(core::is_cancelled([&] { parallel_for(100000, [&](std::size_t) { work.item(); }); }));
    EXPECT_LE(work.most_begun_later(), 1u);
}

TEST(StopScope, ends_loops_inside_the_bodies_of_loops) {
    core::StoppedWork work(20 * thread_count());
    const core::StopScope scope(work.progress());
    EXPECT_TRUE(core::is_cancelled([&] {
        parallel_for(4, [&](std::size_t) {
            parallel_for(4, [&](std::size_t) { parallel_for(100000, [&](std::size_t) { work.item(); }); });
        });
    }));
    EXPECT_LE(work.most_begun_later(), 1u);
}

TEST(StopScope, of_a_verb_inside_another_obeys_both) {
    std::stop_source outer, inner;
    const auto loop = [] { parallel_for(1, [](std::size_t) {}); };
    const core::StopScope whole{Progress(outer.get_token())};
    {
        const core::StopScope part{Progress(inner.get_token())};
        const core::StopScope without{Progress()};
        EXPECT_FALSE(core::is_cancelled(loop));
        inner.request_stop();
        EXPECT_TRUE(core::is_cancelled(loop));
    }
    EXPECT_FALSE(core::is_cancelled(loop)) << "the inner work's stop ends with it";
    outer.request_stop();
    const core::StopScope again{Progress()};
    EXPECT_TRUE(core::is_cancelled(loop));
    EXPECT_TRUE(core::is_cancelled([] { core::throw_if_stopped(); }));
}

TEST(StopScope, leaves_other_threads_alone) {
    std::stop_source source;
    source.request_stop();
    const core::StopScope scope{Progress(source.get_token())};
    std::jthread([] { EXPECT_FALSE(core::is_cancelled([] { parallel_for(10, [](std::size_t) {}); })); }).join();
    EXPECT_TRUE(core::is_cancelled([] { parallel_for(10, [](std::size_t) {}); }));
}

TEST(Isolate, lets_a_stop_through) {
    std::stop_source source;
    source.request_stop();
    const core::StopScope scope{Progress(source.get_token())};
    EXPECT_TRUE(core::is_cancelled([] { isolate([] { parallel_for(10, [](std::size_t) {}); }); }));
}

}  // namespace
}  // namespace hogel::work
