// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace hogel::bench {

/// Return the processor time so far in seconds: of all threads, and of the calling thread.
double processor_seconds();
double thread_seconds();

/// Duration of work in seconds: wall time, and processor time of all threads.
struct Times {
    double wall = 0, processor = 0;
};
Times time_of(const std::function<void()>& work);
/// Returns the medians over rounds. Throws Error(cancelled) after an interrupt.
Times median_time_of(const std::function<void()>& work, std::size_t rounds);

double median(std::vector<double> values);

/// Returns the resident memory of the process in bytes; NaN if the system does not report it.
double memory_held();
/// Returns the maximum resident memory in bytes since the start or since reset_max_memory_held().
double max_memory_held();
/// Returns free memory to the system, resets the maximum, and returns the resident memory in bytes.
double reset_max_memory_held();

}  // namespace hogel::bench
