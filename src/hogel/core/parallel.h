// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hogel/resources.h"

namespace hogel::core {

/// Calls body(i) once for every i in [0, n), on as many threads as the process may use. The order is unspecified, so
/// bodies write to places of their own. The first exception thrown by a body is rethrown here.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

/// Computes body(i) for every i in [0, n) on all threads and calls merge(i, result) in increasing order of i on one
/// thread at a time, with at most `in_flight` results alive: a sum over tiles that is the same for any thread count.
template <class Result>
void parallel_ordered(std::size_t n, std::size_t in_flight, const std::function<Result(std::size_t)>& body,
                      const std::function<void(std::size_t, Result&)>& merge);

/// Runs body on this thread, which while it waits for parallel loops inside does nothing but their work. For whoever
/// holds something that other loops' bodies wait for.
void isolate(const std::function<void()>& body);

/// How many results of parallel_ordered to keep alive so that no thread waits for the merge.
inline std::size_t default_in_flight() { return 4 * thread_count(); }

template <class Result>
void parallel_ordered(std::size_t n, std::size_t in_flight, const std::function<Result(std::size_t)>& body,
                      const std::function<void(std::size_t, Result&)>& merge) {
    std::vector<std::optional<Result>> results(in_flight);
    for (std::size_t first = 0; first < n; first += in_flight) {
        const std::size_t batch = n - first < in_flight ? n - first : in_flight;
        parallel_for(batch, [&](std::size_t i) { results[i].emplace(body(first + i)); });
        for (std::size_t i = 0; i < batch; ++i) {
            merge(first + i, *results[i]);
            results[i].reset();
        }
    }
}

}  // namespace hogel::core
