// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hogel::core {

/// The *_simd.cpp files are compiled once per Highway target (instruction set such as AVX2), and call the best target
/// of the processor at run time. The functions below let tests run every target: all targets must agree, so that a
/// stream decodes to the same bytes on every machine.

/// Returns the targets of this build that the processor supports, as Highway's numbers, best first; at least one.
std::vector<std::int64_t> targets();

/// "AVX2", "SSE4", …
std::string target_name(std::int64_t target);

/// Restricts all SIMD code of the process to this target; 0 restores the best one. For tests. Not thread-safe with
/// respect to running SIMD code. Throws Error(usage) for a target that is not in targets().
void use_target(std::int64_t target);

}  // namespace hogel::core
