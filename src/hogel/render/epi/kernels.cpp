// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

void DepthCells::clear(std::size_t columns, std::size_t directions) {
    constexpr std::size_t padding = 64;
    max_depth.assign(columns * rows(directions) + padding, ~std::uint32_t{0});
    writes = 0;
}

void draw_spans_plain(std::span<const EpiSpan> spans, std::size_t first_number, const EpipolarPlane& plane) {
    const auto first = static_cast<float>(plane.first_column);
    const float last = first + static_cast<float>(plane.columns) - 1;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const EpiSpan& span = spans[i];
        for (std::size_t k = 0; k < plane.directions; ++k) {
            const float K = plane.first_direction + static_cast<float>(k);
            const float c0 = span.x0 - K * span.z0, c1 = span.x1 - K * span.z1;
            const float slope = (span.z1 - span.z0) / (c1 - c0);
            const float low = plane.fronts_only ? c0 : std::min(c0, c1),
                        high = plane.fronts_only ? c1 : std::max(c0, c1);
            const float begin = std::max(first, std::floor(low) + 1), end = std::min(last, std::floor(high));
            for (float n = begin; n <= end; ++n) {
                const float z = span.z0 + (n - c0) * slope;
                std::uint64_t& word = plane.words[static_cast<std::size_t>(n - first) * plane.directions + k];
                word = std::min(word, std::uint64_t{ordered_bits(z)} << 32 | (first_number + i));
            }
        }
    }
}

void find_max_depths_plain(const EpipolarPlane& plane) {
    DepthCells& cells = *plane.cells;
    cells.clear(plane.columns, plane.directions);
    std::fill_n(cells.max_depth.begin(), plane.columns * DepthCells::rows(plane.directions), 0);
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint32_t& cell = cells.max_depth[k / directions_per_cell * plane.columns + column];
            cell = std::max(cell, static_cast<std::uint32_t>(plane.words[column * plane.directions + k] >> 32));
        }
}

void shade_between_ends_plain(const EpipolarPlane& plane, std::span<const SpanValues> spans, const PlaneOutput& out) {
    for (std::size_t column = 0; column < plane.columns; ++column)
        for (std::size_t k = 0; k < plane.directions; ++k) {
            std::uint64_t& word = plane.words[column * plane.directions + k];
            const SpanValues& span = spans[word & 0xffffffff];
            word = EpipolarPlane::empty;
            const float n = static_cast<float>(plane.first_column) + static_cast<float>(column);
            const float position = position_on_span(span, n, plane.first_direction + static_cast<float>(k));
            for (int i = 0; i < 4; ++i)
                if (out.values[i])
                    out.values[i][column * out.strides[i] + k] = span.value0[i] + position * span.difference[i];
        }
}

}  // namespace hogel::render::epi
