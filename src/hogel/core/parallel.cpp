#include "hogel/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace hogel {

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(std::size_t{0}, n, body, tbb::simple_partitioner());
}

void isolate(const std::function<void()>& body) { tbb::this_task_arena::isolate(body); }

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
