// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/session.h"

namespace hogel::bench {

/// Options of `hogel-bench patterns`.
struct PatternBenchOptions {
    std::string scene = "pumpkin";
    std::string device = "pluto";
    std::vector<std::string> encodings;  ///< empty: all but supervised, which needs a light field
    std::size_t rounds = 3;
};

/// Prints the time of encode_pattern() and the quality of its patterns, for the holograms of a scene that `hogel slm`
/// encodes: with smooth phases, and with random ones.
void measure_patterns(const PatternBenchOptions& options, const Session& session);

}  // namespace hogel::bench
