// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/lru_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <thread>

#include "hogel/core/test_errors.h"

namespace hogel::work {
namespace {

using Cache = LruCache<int, int>;
using std::chrono::milliseconds;

std::shared_ptr<const int> of(int value) { return std::make_shared<const int>(value); }

std::shared_ptr<const int> unwanted() {
    ADD_FAILURE() << "made again";
    return of(-1);
}

// Work that only a stop request ends.
std::shared_ptr<const int> endless() {
    parallel_for(1000000, [](std::size_t) { std::this_thread::sleep_for(milliseconds(1)); });
    return of(-2);
}

// Returns a thread that computes the result of key 1 until it is stopped, and has begun.
std::jthread endless_maker(Cache& cache, std::stop_token stop) {
    auto begun = std::make_shared<std::latch>(1);
    std::jthread maker([&cache, stop, begun] {
        const core::StopScope scope{Progress(stop)};
        EXPECT_EQ(core::code_of([&] {
                      cache.get(1, [&] {
                          begun->count_down();
                          return endless();
                      });
                  }),
                  ErrorCode::cancelled);
    });
    begun->wait();
    return maker;
}

TEST(LruCache, keeps_the_results_used_last) {
    Cache cache(2);
    EXPECT_EQ(*cache.get(1, [] { return of(10); }), 10);
    EXPECT_EQ(*cache.get(2, [] { return of(20); }), 20);
    EXPECT_EQ(*cache.get(1, unwanted), 10);
    EXPECT_EQ(*cache.get(3, [] { return of(30); }), 30);
    EXPECT_EQ(*cache.get(1, unwanted), 10);
    EXPECT_EQ(*cache.get(2, [] { return of(21); }), 21) << "was the longest unused";
}

TEST(LruCache, makes_a_result_once_for_all_that_ask_together) {
    Cache cache(4);
    std::atomic<int> made{0};
    parallel_for(200, [&](std::size_t i) {
        const int key = static_cast<int>(i % 4);
        const auto make = [&] {
            ++made;
            std::this_thread::sleep_for(milliseconds(5));
            return of(10 * key);
        };
        EXPECT_EQ(*cache.get(key, make), 10 * key);
    });
    EXPECT_EQ(made, 4);
}

TEST(LruCache, forgets_what_could_not_be_made) {
    Cache cache(2);
    const auto fail = []() -> std::shared_ptr<const int> { throw Error(ErrorCode::bad_input, "no"); };
    EXPECT_EQ(core::code_of([&] { cache.get(1, fail); }), ErrorCode::bad_input);
    EXPECT_EQ(*cache.get(1, [] { return of(10); }), 10);
}

TEST(LruCache, a_stop_of_the_work_that_makes_a_result_is_none_of_those_that_wait_for_it) {
    Cache cache(2);
    std::stop_source source;
    std::jthread maker = endless_maker(cache, source.get_token());
    std::jthread waiter([&] { EXPECT_EQ(*cache.get(1, [] { return of(10); }), 10); });
    std::this_thread::sleep_for(milliseconds(30));
    source.request_stop();
    maker.join();
    waiter.join();
    EXPECT_EQ(*cache.get(1, unwanted), 10);
}

TEST(LruCache, work_that_waits_for_the_result_of_other_work_can_be_stopped) {
    Cache cache(2);
    std::stop_source of_maker, of_waiter;
    std::jthread maker = endless_maker(cache, of_maker.get_token());
    {
        const core::StopScope scope{Progress(of_waiter.get_token())};
        std::jthread soon([&] {
            std::this_thread::sleep_for(milliseconds(30));
            of_waiter.request_stop();
        });
        EXPECT_EQ(core::code_of([&] { cache.get(1, unwanted); }), ErrorCode::cancelled);
    }
    of_maker.request_stop();
}

}  // namespace
}  // namespace hogel::work
