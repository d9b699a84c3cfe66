// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hogel::camera::rays {

/// Linear interpolation at many positions, for photographs by rays. Plain and fast twins give the same bytes.

/// Positions between neighbouring samples of a line: index of the lower neighbour, and weight of the higher one.
struct LinePositions {
    std::span<const std::int32_t> low;
    std::span<const float> high_weight;
};

/// Two rows of directions of the first of several hogels in a row.
struct HogelRows {
    const float* top = nullptr;
    const float* bottom = nullptr;
    std::size_t hogel = 0;  ///< floats from one hogel to the next
    std::size_t next = 1;   ///< stride to the higher neighbour of a direction; 0 for a single direction
    float bottom_weight = 0;
};

/// Computes out[i], the radiance of hogel i, interpolated between two directions and the two rows.
void sample_between_plain(const HogelRows& hogels, const LinePositions& directions, std::span<float> out);
extern decltype(sample_between_plain)& sample_between;

/// Adjacent samples of neighbouring hogels in four neighbouring directions; floats or halves (core/half.h).
template <class Sample>
struct FourDirections {
    const Sample* top_left = nullptr;
    const Sample* top_right = nullptr;
    const Sample* bottom_left = nullptr;
    const Sample* bottom_right = nullptr;
};

/// Computes out[i], the radiance of hogel i, interpolated between the four directions.
void sample_along_plain(const FourDirections<float>& from, std::span<const float> right_weight, float bottom_weight,
                        std::span<float> out);
void sample_along_plain(const FourDirections<std::uint16_t>& from, std::span<const float> right_weight,
                        float bottom_weight, std::span<float> out);
void sample_along(const FourDirections<float>& from, std::span<const float> right_weight, float bottom_weight,
                  std::span<float> out);
void sample_along(const FourDirections<std::uint16_t>& from, std::span<const float> right_weight, float bottom_weight,
                  std::span<float> out);

/// Computes out[i] = a[i] + (b[i] − a[i]) · weight.
void mix_lines_plain(std::span<const float> a, std::span<const float> b, float weight, std::span<float> out);
extern decltype(mix_lines_plain)& mix_lines;

/// Computes out[i] += the value of `line` interpolated between low[i] and low[i] + next.
void add_between_plain(std::span<const float> line, std::size_t next, const LinePositions& positions,
                       std::span<float> out);
extern decltype(add_between_plain)& add_between;

}  // namespace hogel::camera::rays
