// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::cli {

/// The memory that the program holds at present, and its maximum since the start or the last reset, bytes.
double memory_held();
double max_memory_held();
/// Returns free memory to the system, resets the maximum, and returns the memory held.
double forget_most_memory();

/// The memory that the system can still provide, bytes.
double memory_available();

/// Processor time of all threads so far, seconds.
double processor_seconds();

}  // namespace hogel::cli
