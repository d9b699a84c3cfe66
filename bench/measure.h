// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace hogel::bench {

/// Processor time so far, seconds: of all threads, and of the calling thread.
double processor_seconds();
double thread_seconds();

/// The duration of work in seconds: wall time, and processor time of all threads.
struct Times {
    double wall = 0, processor = 0;
};
Times time_of(const std::function<void()>& work);
/// The medians over rounds. Throws Error(cancelled) after an interrupt.
Times median_time_of(const std::function<void()>& work, std::size_t rounds);

double median(std::vector<double> values);

/// Memory that the process holds at present, bytes; NaN if the system does not say.
double memory_held();
/// The maximum memory that it has held since its start or since reset_max_memory_held(), bytes.
double max_memory_held();
/// Returns free memory to the system, resets the maximum, and returns the memory held.
double reset_max_memory_held();

}  // namespace hogel::bench
