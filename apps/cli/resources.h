// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace hogel::cli {

/// How much memory the program holds at present, and has held at most since it began or was last asked to forget; in
/// bytes.
double memory_held();
double max_memory_held();
/// Counts the most anew from now on, and returns what is held. Memory that is free goes back to the system first.
double forget_most_memory();

/// How much memory the machine could still give.
double memory_available();

/// Processor time of all threads until now, in seconds.
double processor_seconds();

}  // namespace hogel::cli
