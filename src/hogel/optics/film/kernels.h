// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace hogel::optics::film {

/// The inner loops that resample a film to a picture, by TwelvePoint interpolation. Plain and fast twins agree to
/// rounding. Values are zero where a neighbour would be outside.

/// out[i] = the sum over `scales` of the values of column i of `values` (`height` rows of `stride` floats) at the rows
/// offset + scale · slopes[i].
struct ColumnPoints {
    std::span<const double> slopes;  ///< one per element of `out`
    std::span<const double> scales;
    double offset = 0;
};
void sum_down_columns_plain(const float* values, std::size_t stride, std::size_t height, const ColumnPoints& points,
                            std::span<float> out);
/// The weights of all points together are those of three slopes and, for the columns between them, polynomials of the
/// second degree: to 5·10⁻⁴ of the largest value for each point.
void sum_down_columns(const float* values, std::size_t stride, std::size_t height, const ColumnPoints& points,
                      std::span<float> out);

/// out[k] += weight · r³ · the value of `line` at offset + scale · d/r, with d = first + k · pitch and
/// r = √(d² + square): the light in direction sine d/r. Values below zero count as zero.
struct LinePlaces {
    double first = 0, pitch = 0, square = 0;
    double scale = 0, offset = 0;
};
void add_along_line_plain(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out);
void add_along_line(std::span<const float> line, const LinePlaces& places, float weight, std::span<float> out);

}  // namespace hogel::optics::film
