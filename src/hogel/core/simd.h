// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hogel::core {

/// The *_simd.cpp files are compiled once for every Highway target (an instruction set such as AVX2) and call the best
/// one that the processor has. The functions below let tests run each of them, because a stream decodes to the same
/// bytes on every machine only if all targets agree.

/// The targets that this build contains and this processor supports, by Highway's numbers, best first; at least one.
std::vector<std::int64_t> targets();

/// "AVX2", "SSE4", …
std::string target_name(std::int64_t target);

/// From now on all SIMD code of the process uses only this target, or with 0 the best one again. For tests; must not be
/// called while such code runs on other threads. Throws Error(usage) for a target that is not in targets().
void use_target(std::int64_t target);

}  // namespace hogel::core
