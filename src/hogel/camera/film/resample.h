// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "hogel/camera/film/interpolation.h"
#include "hogel/optics/lines.h"

namespace hogel::camera::film {

/// Positions, in samples, at which resample_lines() reads sixteen lines: uniform steps of a direction sine. Value i
/// belongs to the sine s = first + i · step. Its position on line k is offset + scales[k] · s/√(squares[k] − s²).
/// Squares are 1 minus the square of the other direction sine, so the fraction is the tangent of the direction. Either
/// all scales or all squares are the same.
struct TangentPositions {
    double first = 0, step = 0;
    double offset = 0;
    std::array<double, optics::block_lines> squares, scales;
};

/// Computes out[i], the values of the lines (zero outside) at position i, interpolated by `table`. Lines and values are
/// interleaved complex numbers, [i][part][line]. The fast twin takes the weights of all lines from those of a few of
/// them (line_shares.h). For signals in the passband of the table, both are within 2·10⁻³.
/// @param size  samples of a line
void resample_lines_plain(const float* lines, std::size_t size, const TangentPositions& positions,
                          const InterpolationTable& table, std::size_t count, float* out);
void resample_lines(const float* lines, std::size_t size, const TangentPositions& positions,
                    const InterpolationTable& table, std::size_t count, float* out);

/// Nodes of the fast twin among sixteen lines, and the parameter t = −1 … 1 of each line, see line_shares().
struct TangentNodes {
    static constexpr std::size_t max = 5;
    std::size_t nodes = 0;
    double squares[max], scales[max];
    alignas(64) float t[optics::block_lines],
        mask[optics::block_lines];  ///< 1: the values of the line are stored
};
extern void (&resample_nodes)(const float* lines, std::size_t size, const TangentPositions& positions,
                              const TangentNodes& nodes, const InterpolationTable& table, std::size_t count,
                              float* out);

}  // namespace hogel::camera::film
