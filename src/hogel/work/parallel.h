// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hogel/resources.h"

namespace hogel::work {

/// Calls body(i) once for every i in [0, n), on all threads of the process. The order is unspecified, and bodies must
/// not write to the same memory. Rethrows the first exception of a body. Returns after all bodies have run. Throws
/// Error(cancelled) if an enclosing loop has failed elsewhere.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

/// Computes body(i) for every i in [0, n) on all threads. Calls merge(i, result) in increasing order of i on the
/// calling thread: a sum over tiles is the same for any number of threads. Keeps at most `in_flight` results in memory.
template <class Result>
void local_ordered_reduce(std::size_t n, std::size_t in_flight, const std::function<Result(std::size_t)>& body,
                          const std::function<void(std::size_t, Result&)>& merge);

/// Runs `body` on this thread. While the thread waits for parallel loops inside `body`, it executes only their tasks.
/// Needed for code that holds a lock or a promise for which bodies of other loops wait.
void isolate(const std::function<void()>& body);

/// Returns a default for in_flight of local_ordered_reduce(), four results per thread: threads then seldom wait for the
/// merge.
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
