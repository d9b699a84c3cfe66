// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hogel::core {

/// The *_simd.cpp files are compiled once for every Highway target (an instruction set such as AVX2) and call the best
/// one that the processor has. What follows lets tests run each of them, because a stream decodes to the same bytes on
/// every machine only if all targets agree.

/// The targets that the build contains and this processor has, as Highway numbers them, best first; at least one.
std::vector<std::int64_t> targets();

/// "AVX2", "SSE4", …
std::string target_name(std::int64_t target);

/// From now on all SIMD code of the process runs on this target alone, or with 0 on the best one again. For tests; not
/// while such code runs on other threads. Throws Error(usage) for a target that is not in targets().
void use_target(std::int64_t target);

}  // namespace hogel::core
