// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

void PlaneCells::clear(std::size_t columns, std::size_t directions) {
    constexpr std::size_t spare = 64;
    farthest.assign(columns * rows(directions) + spare, ~std::uint32_t{0});
    drawn = 0;
}

void draw_plain(std::span<const Strip> strips, std::size_t first_number, const EpipolarPlane& plane) {
    const auto first = static_cast<float>(plane.first_column);
    const float last = first + static_cast<float>(plane.columns) - 1;
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const Strip& strip = strips[i];
        for (std::size_t k = 0; k < plane.directions; ++k) {
            const float K = plane.first_direction + static_cast<float>(k);
            const float c0 = strip.x0 - K * strip.z0, c1 = strip.x1 - K * strip.z1;
            const float slope = (strip.z1 - strip.z0) / (c1 - c0);
            const float low = plane.fronts_only ? c0 : std::min(c0, c1),
                        high = plane.fronts_only ? c1 : std::max(c0, c1);
            const float begin = std::max(first, std::floor(low) + 1), end = std::min(last, std::floor(high));
            for (float n = begin; n <= end; ++n) {
                const float z = strip.z0 + (n - c0) * slope;
                std::uint64_t& word = plane.words[static_cast<std::size_t>(n - first) * plane.directions + k];
                word = std::min(word, std::uint64_t{ordered_bits(z)} << 32 | (first_number + i));
            }
        }
    }
}

void find_farthest_plain(const EpipolarPlane& plane) {
    PlaneCells& cells = *plane.cells;
    cells.clear(plane.columns, plane.directions);
    std::fill_n(cells.farthest.begin(), plane.columns * PlaneCells::rows(plane.directions), 0);
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint32_t& cell = cells.farthest[k / cell_directions * plane.columns + column];
            cell = std::max(cell, static_cast<std::uint32_t>(plane.words[column * plane.directions + k] >> 32));
        }
}

void shade_plain(const EpipolarPlane& plane, std::span<const StripShades> strips, const ShadedPlane& out) {
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint64_t& word = plane.words[column * plane.directions + k];
            const StripShades& strip = strips[word & 0xffffffff];
            word = EpipolarPlane::nothing;
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            const float part = part_of_strip(strip, n, plane.first_direction + static_cast<float>(k));
            for (int i = 0; i < 4; ++i)
                if (out.values[i])
                    out.values[i][column * out.strides[i] + k] = strip.value0[i] + part * strip.difference[i];
        }
}

}  // namespace hogel::render::epi
