// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace hogel::core {

#ifdef __SANITIZE_THREAD__

// The distribution's TBB is not instrumented: the thread sanitizer sees neither how a loop's work reaches other threads
// nor how its end comes back, and takes every loop for a race. Its builds run loops on plain threads instead.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr first;
    const auto work = [&] {
        for (std::size_t i = next++; i < n; i = next++) {
            try {
                body(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!first) first = std::current_exception();
                next = n;
            }
        }
    };
    {
        std::vector<std::jthread> others(n > 1 ? std::min(thread_count(), n) - 1 : 0);
        for (std::jthread& other : others) other = std::jthread(work);
        work();
    }
    if (first) std::rethrow_exception(first);
}

#else

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(std::size_t{0}, n, body, tbb::simple_partitioner());
}

#endif

void isolate(const std::function<void()>& body) { tbb::this_task_arena::isolate(body); }

}  // namespace hogel::core

namespace hogel {

struct ThreadLimit::Limit {
    explicit Limit(std::size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::size_t threads) {
    if (threads > 0) limit_ = std::make_unique<Limit>(threads);
}

ThreadLimit::~ThreadLimit() = default;

std::size_t thread_count() {
    const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const auto machine = static_cast<std::size_t>(tbb::info::default_concurrency());
    return allowed < machine ? allowed : machine;
}

}  // namespace hogel
