// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hogel/resources.h"

namespace hogel::work {

/// Calls body(i) once for every i in [0, n), on as many threads as the process may use. The order is unspecified, so
/// bodies must not write to the same memory. The first exception thrown by a body is rethrown. Returns only when all
/// bodies have run; if an enclosing loop has failed elsewhere, it throws Error(cancelled).
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

/// Computes body(i) for every i in [0, n) on all threads and calls merge(i, result) in increasing order of i on the
/// calling thread, with at most `in_flight` results alive. Thus a sum over tiles is the same for any number of threads.
template <class Result>
void local_ordered_reduce(std::size_t n, std::size_t in_flight, const std::function<Result(std::size_t)>& body,
                          const std::function<void(std::size_t, Result&)>& merge);

/// Runs body on this thread; while the thread waits for parallel loops inside body, it executes only their tasks. For
/// code that holds something, such as a lock or a promise, for which bodies of other loops wait.
void isolate(const std::function<void()>& body);

/// The number of results that local_ordered_reduce() keeps alive so that threads seldom wait for the merge.
inline std::size_t default_in_flight() { return 4 * thread_count(); }

template <class Result>
void local_ordered_reduce(std::size_t n, std::size_t in_flight, const std::function<Result(std::size_t)>& body,
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

}  // namespace hogel::work
