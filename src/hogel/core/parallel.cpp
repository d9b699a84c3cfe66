// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>
#include <utility>

#include "hogel/stop.h"

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace hogel::core {
namespace {

// The innermost scope of this thread.
thread_local const StopScope* current_scope = nullptr;

// Lets this thread inherit the scope of the thread that began a loop.
class Inherited {
  public:
    explicit Inherited(const StopScope* scope) : before_(std::exchange(current_scope, scope)) {}
    ~Inherited() { current_scope = before_; }
    Inherited(const Inherited&) = delete;
    Inherited& operator=(const Inherited&) = delete;

  private:
    const StopScope* before_;
};

[[noreturn]] void throw_cancelled() { throw Error(ErrorCode::cancelled, "stopped on request"); }

}  // namespace

StopScope::StopScope(const Progress& progress) : stop_(progress.stop()), outer_(current_scope) {
    if (stop_.stop_possible() && !(outer_ && outer_->stop_ == stop_)) current_scope = this;
}

StopScope::~StopScope() { current_scope = outer_; }

bool StopScope::requested() const { return stop_.stop_requested() || (outer_ && outer_->requested()); }

void throw_if_stopped() {
    if (current_scope && current_scope->requested()) throw_cancelled();
}

#ifdef __SANITIZE_THREAD__

// The distribution's TBB is not instrumented: the thread sanitizer sees neither how work reaches other threads nor how
// results come back, and reports every loop as a race. Builds with it therefore run loops on plain threads.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr first;
    const auto work = [&, scope = current_scope] {
        const Inherited inherited(scope);
        for (std::size_t i = next++; i < n; i = next++) {
            try {
                throw_if_stopped();
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
    const auto run = [&body, scope = current_scope](std::size_t i) {
        const Inherited inherited(scope);
        throw_if_stopped();
        body(i);
    };
    tbb::parallel_for(std::size_t{0}, n, run, tbb::simple_partitioner(), context);
    // If the enclosing loop has failed, TBB skips bodies of this one silently.
    if (context.is_group_execution_cancelled()) throw_cancelled();
}

#endif

void isolate(const std::function<void()>& body) { tbb::this_task_arena::isolate(body); }

}  // namespace hogel::core

namespace hogel {

struct Stoppable::Scope {
    explicit Scope(const Progress& progress) : scope(progress) {}
    core::StopScope scope;
};

Stoppable::Stoppable(const Progress& progress) : scope_(std::make_unique<Scope>(progress)) {}

Stoppable::~Stoppable() = default;

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
