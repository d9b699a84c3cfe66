// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/scene.h"

namespace hogel::bench {

/// The options of `hogel-bench codec`.
struct CodecOptions {
    std::string input;   ///< a light field file, a scene, or a dense light field: dense, dense-hdr
    std::string output;  ///< folder for a plot; empty: none
    LightFieldOptions light_field;
    std::vector<std::string> coders, transforms;  ///< empty: all
    std::vector<std::string> peers;
    std::vector<double> sqnrs{25, 30, 35, 40};  ///< decibels at which rates are printed
    std::vector<double> rates{8};               ///< pixels per bit at which SQNRs are printed
    bool grey = false;                          ///< whether the mean of the colours is coded instead of the colours
    bool thesis = false;                        ///< whether the plot has the point that [K] gives
};

/// Prints the size of a light field against its quality for coders and peers, and their speed.
void measure_codec(const CodecOptions& options, const Session& session);

}  // namespace hogel::bench
