// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/codec/thesis_curves.h"
#include "bench/scene.h"

namespace hogel::bench {

/// Options of `hogel-bench codec`.
struct CodecOptions {
    std::string input;   ///< a light field file, a scene, or a dense light field: dense, dense-hdr
    std::string output;  ///< folder for a plot; empty: none
    LightFieldOptions light_field;
    std::vector<std::string> coders, transforms;  ///< empty: all
    std::vector<std::string> peers;
    std::vector<double> sqnrs{25, 30, 35, 40};  ///< decibels at which rates are printed
    std::vector<double> rates{8};               ///< pixels per bit at which SQNRs are printed
    bool grey = false;                          ///< whether to code the mean of the colours
    bool thesis = false;                        ///< whether to plot the point of [K]
};

/// Prints the size of a light field against its quality for coders and peers, and their speed.
void measure_codec(const CodecOptions& options, const Session& session);

/// Options of `hogel-bench thesis`.
struct ThesisOptions {
    std::string output;  ///< folder for the figures; empty: none
    std::vector<std::string> scenes{"pumpkin", "church"};
    LightFieldOptions light_field;
    std::vector<double> rates = ThesisMeasurement().rates;
    std::vector<std::string> transforms;  ///< empty: all
    bool radiance = false;                ///< whether to code L instead of √L
    std::size_t crop = 192, columns = 6;  ///< side of the pictures, and number of pictures in a row

    ThesisOptions() {
        light_field.hogels = {128, 1};
        light_field.across = 360;
        light_field.directions = {512, 512};
        light_field.field_of_view = {16_deg, 16_deg};
    }
};

/// Prints the curves of [K] fig. 4.18 to 4.20 as a table, and draws them and the pictures of fig. 4.21 to 4.29. The
/// lumigraphs have horizontal parallax, one channel, and hogels as dense as those of [K].
void redraw_thesis(const ThesisOptions& options, const Session& session);

}  // namespace hogel::bench
