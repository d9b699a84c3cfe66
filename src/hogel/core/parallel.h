// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "hogel/progress.h"
#include "hogel/resources.h"

namespace hogel::core {

/// While it lives, parallel loops begun by this thread, and loops inside their bodies on any thread, end with
/// Error(cancelled) when the work's stop token is asked to stop. Every public function that takes a Progress begins
/// with one, so that code between it and a loop need not pass the token on. Scopes nest: a stop of any of them counts.
class StopScope {
  public:
    explicit StopScope(const Progress& progress);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

    bool requested() const;

  private:
    std::stop_token stop_;
    const StopScope* outer_;
};

/// Throws Error(cancelled) where a scope that this thread works in was asked to stop. For long loops on one thread;
/// parallel_for() does it before each body.
void throw_if_stopped();

/// Calls body(i) once for every i in [0, n), on as many threads as the process may use. The order is unspecified, so
/// bodies write to places of their own. The first exception thrown by a body is rethrown here. Returns only when all
/// bodies have run: a loop inside the body of another that has failed elsewhere throws Error(cancelled).
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

/// Computes body(i) for every i in [0, n) on all threads and calls merge(i, result) in increasing order of i on the
/// calling thread, with at most `in_flight` results alive: a sum over tiles is the same for any number of threads.
template <class Result>
void parallel_ordered(std::size_t n, std::size_t in_flight, const std::function<Result(std::size_t)>& body,
                      const std::function<void(std::size_t, Result&)>& merge);

/// Runs body on this thread, which while it waits for parallel loops inside does nothing but their work: for code that
/// holds something (a lock, a promise) that bodies of other loops wait for.
void isolate(const std::function<void()>& body);

/// How many results parallel_ordered may keep alive so that threads seldom wait for the merge.
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
