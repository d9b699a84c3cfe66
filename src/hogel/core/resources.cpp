// SPDX-License-Identifier: Apache-2.0
#include "hogel/resources.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

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
