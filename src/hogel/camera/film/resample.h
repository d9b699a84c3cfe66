// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "hogel/camera/film/interpolation.h"
#include "hogel/optics/lines.h"

namespace hogel::camera::film {

/// The places on sixteen lines of samples at uniform steps of a direction sine: value i of a line is at
/// offset + scale · s/√(square − s²), s = first + i · step. Either the scale or the square is the same for all lines.
struct TangentPositions {
    double first = 0, step = 0;
    double offset = 0;
    std::array<double, optics::block_lines> squares, scales;
};

/// out[i] = the values of the lines (zero outside) at place i, interpolated by `table`; lines and values are complex
/// numbers side by side, [i][part][line].
/// The fast twin takes the weights of all lines from those of a few of them (line_shares.h). Of signals that the table
/// passes, both are within 2·10⁻³.
/// @param size  samples of a line
void resample_lines_plain(const float* lines, std::size_t size, const TangentPositions& places,
                          const InterpolationTable& table, std::size_t count, float* out);
void resample_lines(const float* lines, std::size_t size, const TangentPositions& places,
                    const InterpolationTable& table, std::size_t count, float* out);

/// Some of sixteen lines and the values of t = −1 … 1 that say where each lies between `nodes` of them: see
/// line_shares(). The step of the fast twin.
struct TangentNodes {
    static constexpr std::size_t max = 5;
    std::size_t nodes = 0;
    double squares[max], scales[max];
    alignas(64) float t[optics::block_lines],
        chosen[optics::block_lines];  ///< chosen: 1 for lines whose values are stored
};
extern void (&resample_nodes)(const float* lines, std::size_t size, const TangentPositions& places,
                              const TangentNodes& nodes, const InterpolationTable& table, std::size_t count,
                              float* out);

}  // namespace hogel::camera::film
