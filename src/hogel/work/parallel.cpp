// SPDX-License-Identifier: Apache-2.0
#include "hogel/work/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace hogel::work {

#ifdef __SANITIZE_THREAD__

// The distribution's TBB is not instrumented: the thread sanitizer does not see how TBB passes work between threads,
// and reports every loop as a race. Builds with it therefore run loops on plain threads.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr first;
    const auto work = [&, scope = core::stop_scope()] {
        const core::InheritedStopScope inherited(scope);
        for (std::size_t i = next++; i < n; i = next++) {
            try {
                core::throw_if_stopped();
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
    tbb::task_group_context context;
    const auto run = [&body, scope = core::stop_scope()](std::size_t i) {
        const core::InheritedStopScope inherited(scope);
        core::throw_if_stopped();
        body(i);
    };
    tbb::parallel_for(std::size_t{0}, n, run, tbb::simple_partitioner(), context);
    // TBB silently skips bodies of this loop if the enclosing loop has failed.
    if (context.is_group_execution_cancelled()) throw Error(ErrorCode::cancelled, "stopped on request");
}

#endif

void isolate(const std::function<void()>& body) { tbb::this_task_arena::isolate(body); }

}  // namespace hogel::work
