// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/slab.h"

namespace hogel::simplex {

using namespace render;

namespace {

Vec3 direction_of(const LightFieldGrid& grid, const RowAxes& axes, std::size_t slow, std::size_t fast) {
    const auto [t, s, v, u] = axes.sample(0, 0, slow, fast);
    return grid.direction_of(grid.u(static_cast<double>(u)), grid.v(static_cast<double>(v)));
}

}  // namespace

SlabTriangles slab_triangles(const ShadedScene& scene, SlabTriangles list) {
    list.resize(scene.triangles.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto& [a, b, c] = scene.triangles[i].vertices;
        list[i] = {
            corners_of(scene, i), {scene.radiance[a], scene.radiance[b], scene.radiance[c]}, scene.needs_samples(i)};
    }
    return list;
}

TriangleBlock::TriangleBlock() {
    // Value of padding, which lies in no row.
    constexpr float nowhere = 1e30f;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        std::ranges::fill(row[corner], nowhere);
        std::ranges::fill(depth[corner], 0.0f);
    }
    std::ranges::fill(triangle, NearestTriangle::none);
    min_row = min_depth = std::numeric_limits<float>::infinity();
    max_row = max_depth = -std::numeric_limits<float>::infinity();
}

void TriangleBlock::set(std::size_t i, std::uint32_t index, const std::array<double, 3>& rows,
                        const std::array<double, 3>& depths) {
    triangle[i] = index;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto r = row[corner][i] = static_cast<float>(rows[corner]);
        const auto z = depth[corner][i] = static_cast<float>(depths[corner]);
        min_row = std::min(min_row, r);
        max_row = std::max(max_row, r);
        min_depth = std::min(min_depth, z);
        max_depth = std::max(max_depth, z);
    }
}

std::size_t find_in_rows_plain(const TriangleBlock& block, const SlabRows& rows, std::uint32_t* found) {
    const float margin = rows.margin(block);
    std::size_t count = 0;
    for (std::size_t i = 0; i < TriangleBlock::size; ++i) {
        const float a = block.row[0][i] - rows.slope * block.depth[0][i];
        const float b = block.row[1][i] - rows.slope * block.depth[1][i];
        const float c = block.row[2][i] - rows.slope * block.depth[2][i];
        const float low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
        const float first = std::ceil(std::max(low - margin, 0.0f));
        const float last = std::floor(std::min(high + margin, rows.last));
        if (first <= last) found[count++] = block.triangle[i];
    }
    return count;
}

double SlabRays::slow_slope_of(const LightFieldGrid& grid, const RowAxes& axes, std::size_t slow) {
    const Vec3 direction = direction_of(grid, axes, slow, 0);
    return (axes.transposed() ? direction.x : direction.y) / direction.z;
}

double SlabRays::fast_slope_of(const LightFieldGrid& grid, const RowAxes& axes, std::size_t slow, std::size_t fast) {
    const Vec3 direction = direction_of(grid, axes, slow, fast);
    return (axes.transposed() ? direction.y : direction.x) / direction.z;
}

SlabRays::SlabRays(std::span<const SlabTriangle> triangles, bool fronts_only, const LightFieldGrid& grid,
                   const HogelRange& range, std::size_t slow)
    : triangles_(triangles),
      fronts_only_(fronts_only),
      grid_(grid),
      range_(range),
      axes_(grid),
      rows_(axes_.slow_hogels(range)),
      hogels_(axes_.fast_hogels(range)),
      directions_(axes_.fast_directions()),
      slow_slope_(slow_slope_of(grid, axes_, slow)),
      first_fast_(axes_.transposed() ? 0.5 * static_cast<double>(grid.hogels_t) - static_cast<double>(range.t0) - 0.5
                                     : static_cast<double>(range.s0) + 0.5 - 0.5 * static_cast<double>(grid.hogels_s)),
      slopes_(directions_ + padding),
      steps_(directions_ + padding) {
    for (std::size_t k = 0; k < directions_; ++k) {
        slopes_[k] = fast_slope_of(grid, axes_, slow, k);
        steps_[k] = slopes_[k] * axes_.fast_sign();
    }
}

void see_sample(const Band& band, const SlabRays& rays, std::size_t hogel, std::size_t direction,
                std::uint64_t* words) {
    const VisiblePoint point = rays.sees(band.triangle, band.row, hogel, direction);
    std::uint64_t& word = words[rays.word(band.row, hogel, direction)];
    // A depth beyond the largest float becomes infinity, as in the word of no triangle.
    const auto depth = static_cast<float>(point.depth);
    if (depth < std::numeric_limits<float>::infinity()) word = std::min(word, seen_word(depth, band.triangle));
}

void draw_bands_plain(std::span<const Band> bands, const SlabRays& rays, std::uint64_t* words, Visits& visits) {
    for (const Band& band : bands)
        for (std::size_t k = band.columns.first; k < band.columns.end; ++k) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            for (std::size_t i = 0; i < band.count; ++i) {
                const double s = band.points[i].x - rays.steps()[k] * band.points[i].depth;
                low = std::min(low, s);
                high = std::max(high, s);
            }
            const Span hogels = samples_between(low, high, rays.hogels());
            if (hogels.first == hogels.end) continue;
            ++visits.slices;
            visits.samples += hogels.size();
            for (std::size_t i = hogels.first; i < hogels.end; ++i) see_sample(band, rays, i, k, words);
        }
}

}  // namespace hogel::simplex
