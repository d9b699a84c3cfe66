// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/simploid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hogel/core/stop_scope.h"
#include "hogel/render/region_memory.h"
#include "thesis/simplex/slab.h"

namespace hogel::simplex {

using namespace render;

namespace {

// Returns the depth buffer, [slow hogels][fast hogels][fast directions]: the rays of one V.
Shape<3> simploid_buffer(const RowAxes& axes, const HogelRange& region) {
    return {axes.slow_hogels(region), axes.fast_hogels(region), axes.fast_directions()};
}

// Corners of a triangle projected along the directions of one V: for each the row of hogels that sees it, x, and ζ.
struct ProjectedTriangle {
    std::array<double, 3> row;
    std::array<SegmentPoint, 3> corners;

    // Adds to a band the points at which edges cross a row, and corners within the margin of the row.
    void slice(double level, Band& band) const {
        band.count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = i == 2 ? 0 : i + 1;
            if (std::abs(row[i] - level) <= scan_margin) band.include(corners[i]);
            if ((row[i] < level && level < row[j]) || (row[j] < level && level < row[i])) {
                const double part = (level - row[i]) / (row[j] - row[i]);
                band.include({corners[i].x + part * (corners[j].x - corners[i].x),
                              corners[i].depth + part * (corners[j].depth - corners[i].depth)});
            }
        }
    }
};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    // Returns whether numbers with rounding errors may lie between 0 and `last`.
    bool may_reach(double last) const {
        const double margin = 1e-3 + 1e-12 * std::max(std::abs(low), std::abs(high));
        return !(high < -margin || low > last + margin);
    }
};

// In this file t and V are the slow axis of RowAxes, s and U the fast axis. On the left and right of a hemicube s and U
// are the slow axis, t and V the fast axis.
class SimploidRenderer final : public Renderer, public CountsVisits {
  public:
    SimploidRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid), axes_(grid) {
        SimploidRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        scene_ = std::move(scene);
        with_area_ = triangles_with_area(*scene_, std::move(with_area_));
        triangles_ = slab_triangles(*scene_, std::move(triangles_));
    }

    void read(LightFieldTile& tile) const override {
        const TriangleBlocks blocks = blocks_in_view(tile.range);
        // Processes one V at a time, so that neighbouring triangles write to neighbouring memory.
        Array<std::uint64_t, 3> words(simploid_buffer(axes_, tile.range));
        Visits visits;
        for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow) {
            core::throw_if_stopped();
            std::ranges::fill(words.elements(), nothing_seen());
            const SlabRays rays(triangles_, scene_->fronts_only, grid_, tile.range, slow);
            Slab(*this, rays, tile.range, words.elements().data(), visits).scan_convert(blocks);
            store_slab(tile, rays, slow, words);
        }
        add_visits(visits);
    }

  private:
    // Ranges of the slopes of all directions, along both axes; along the fast one in the direction of rising hogels.
    struct Slopes {
        Range slow, fast;
    };
    Slopes slopes() const {
        Slopes ranges;
        const std::size_t last = axes_.fast_directions() - 1;
        for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow) {
            ranges.slow.include(SlabRays::slow_slope_of(grid_, axes_, slow));
            // Slopes are uniform between the first and the last.
            for (const std::size_t fast : {std::size_t{0}, last})
                ranges.fast.include(SlabRays::fast_slope_of(grid_, axes_, slow, fast) * axes_.fast_sign());
        }
        return ranges;
    }

    // Returns the triangles that hogels of a region may see.
    TriangleBlocks blocks_in_view(const HogelRange& range) const {
        const Slopes ranges = slopes();
        const double per_pitch = 1 / grid_.pitch, row_sign = -axes_.fast_sign();
        const double first_row = axes_.slow_hogel(range, 0), first_hogel = axes_.fast_hogel(range, 0);
        const auto last_row = static_cast<double>(axes_.slow_hogels(range) - 1),
                   last_hogel = static_cast<double>(axes_.fast_hogels(range) - 1);
        TriangleBlocks blocks;
        std::size_t used = TriangleBlock::size;
        for (const std::uint32_t index : with_area_) {
            std::array<double, 3> rows, depths;
            Range seen_rows, seen_columns;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& p = triangles_[index].corners[i];
                const double depth = -p.z * per_pitch;
                rows[i] = row_sign * ((axes_.transposed() ? p.x : p.y) - first_row) * per_pitch;
                depths[i] = row_sign * depth;
                const double column = axes_.fast_sign() * ((axes_.transposed() ? p.y : p.x) - first_hogel) * per_pitch;
                for (const double slope : {ranges.slow.low, ranges.slow.high})
                    seen_rows.include(rows[i] - slope * depths[i]);
                for (const double step : {ranges.fast.low, ranges.fast.high})
                    seen_columns.include(column - step * depth);
            }
            if (!seen_rows.may_reach(last_row) || !seen_columns.may_reach(last_hogel)) continue;
            if (used == TriangleBlock::size) {
                blocks.emplace_back();
                used = 0;
            }
            blocks.back().set(used++, index, rows, depths);
        }
        return blocks;
    }

    void store_slab(LightFieldTile& tile, const SlabRays& rays, std::size_t slow,
                    const Array<std::uint64_t, 3>& words) const {
        const std::span<const std::uint64_t> elements = words.elements();
        std::size_t number = 0;
        for (std::size_t row = 0; row < rays.rows(); ++row)
            for (std::size_t i = 0; i < rays.hogels(); ++i) {
                const auto [t, s, v, u] = axes_.sample(row, i, slow, 0);
                const SampleRow to(tile, axes_.transposed() ? grid_.directions_u : 1, t, s, v, u);
                for (std::size_t fast = 0; fast < rays.directions(); ++fast, ++number) {
                    constexpr std::size_t ahead = 24;
                    if (number + ahead < elements.size())
                        if (const auto later = triangle_of(elements[number + ahead]); later != NearestTriangle::none)
                            triangles_[later].fetch();
                    const std::uint32_t index = triangle_of(elements[number]);
                    if (index == NearestTriangle::none) {
                        to.store(fast, scene_->background, std::numeric_limits<double>::infinity());
                        continue;
                    }
                    const SlabTriangle& triangle = triangles_[index];
                    const VisiblePoint point = rays.sees(index, row, i, fast);
                    if (triangle.needs_samples) {
                        const auto sample = axes_.sample(row, i, slow, fast);
                        store(tile, *scene_, grid_, point, sample.t, sample.s, sample.v, sample.u);
                    } else {
                        const auto& [a, b, c] = triangle.radiance;
                        to.store(fast, point.b0 * a + point.b1 * b + point.b2 * c, point.depth);
                    }
                }
            }
    }

    // Samples of one hogel and one V in a tile, as the destination of store().
    class SampleRow {
      public:
        SampleRow(LightFieldTile& tile, std::size_t stride, std::size_t t, std::size_t s, std::size_t v, std::size_t u)
            : stride_(stride), channels_(tile.radiance.extent(0)) {
            for (std::size_t c = 0; c < channels_; ++c) radiance_[c] = &tile.radiance(c, t, s, v, u);
            if (tile.depth.size() > 0) depth_ = &tile.depth(t, s, v, u);
        }

        void store(std::size_t direction, Rgb radiance, double depth) const {
            const std::size_t i = direction * stride_;
            if (channels_ == 3) {
                radiance_[0][i] = radiance.r;
                radiance_[1][i] = radiance.g;
                radiance_[2][i] = radiance.b;
            } else {
                radiance_[0][i] = luminance(radiance);
            }
            if (depth_) depth_[i] = static_cast<float>(depth);
        }

      private:
        std::size_t stride_, channels_;
        std::array<float*, 3> radiance_{};
        float* depth_ = nullptr;
    };

    class Slab {
      public:
        Slab(const SimploidRenderer& renderer, const SlabRays& rays, const HogelRange& range, std::uint64_t* words,
             Visits& visits)
            : axes_(renderer.axes_),
              rays_(rays),
              words_(words),
              visits_(visits),
              per_pitch_(1 / renderer.grid_.pitch),
              first_row_(axes_.slow_hogel(range, 0) / renderer.grid_.pitch),
              first_hogel_(axes_.fast_hogel(range, 0) / renderer.grid_.pitch * axes_.fast_sign()),
              bands_(max_bands) {}

        void scan_convert(const TriangleBlocks& blocks) {
            const SlabRows rows{static_cast<float>(rays_.slow_slope()), static_cast<float>(rays_.rows() - 1)};
            std::array<std::uint32_t, TriangleBlock::size> found;
            for (const TriangleBlock& block : blocks) {
                if (!rows.may_show(block)) continue;
                const std::size_t count = find_in_rows(block, rows, found.data());
                constexpr std::size_t ahead = 8;
                for (std::size_t i = 0; i < count; ++i) {
                    rays_.triangle(found[std::min(i + ahead, count - 1)]).fetch();
                    slice(found[i]);
                }
            }
            draw();
        }

      private:
        static constexpr std::size_t max_bands = 64;

        void slice(std::uint32_t index) {
            const ProjectedTriangle triangle = project(index);
            const auto [low, high] = std::minmax({triangle.row[0], triangle.row[1], triangle.row[2]});
            const Span rows = samples_between(low, high, rays_.rows());
            visits_.pieces += rows.size() > 0 ? 1 : 0;
            for (std::size_t row = rows.first; row < rows.end; ++row) {
                Band& band = bands_[band_count_];
                triangle.slice(static_cast<double>(row), band);
                if (band.count == 0) continue;
                band.columns = columns_of_directions(band);
                if (band.columns.size() == 0) continue;
                set_triangle(band, index, row);
                if (++band_count_ == max_bands) draw();
            }
        }

        ProjectedTriangle project(std::uint32_t index) const {
            ProjectedTriangle projected;
            const double row_sign = -axes_.fast_sign();  // t is counted downwards, s to the right
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& p = rays_.triangle(index).corners[i];
                const double depth = -p.z * per_pitch_;
                const double fast = (axes_.transposed() ? p.y : p.x) * per_pitch_;
                const double slow = (axes_.transposed() ? p.x : p.y) * per_pitch_;
                projected.row[i] = row_sign * (slow - rays_.slow_slope() * depth - first_row_);
                projected.corners[i] = {axes_.fast_sign() * fast - first_hogel_, depth};
            }
            return projected;
        }

        void set_triangle(Band& band, std::uint32_t index, std::size_t row) const {
            band.triangle = index;
            band.row = row;
            const double row_position = rays_.slow_hogel(row);
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& p = rays_.triangle(index).corners[i];
                band.depth[i] = -p.z;
                band.fast[i] = axes_.transposed() ? p.y : p.x;
                // Rounded as in ObliqueTriangle.
                band.slow[i] = ((axes_.transposed() ? p.x : p.y) - rays_.slow_slope() * band.depth[i]) - row_position;
            }
        }

        // Returns the directions in which hogels of the tile may see a segment: all if it is close to the hologram
        // plane, where directions are undefined.
        Span columns_of_directions(const Band& band) const {
            constexpr double margin = 1e-3;
            Range seen, depths;
            for (std::size_t i = 0; i < band.count; ++i) {
                const auto [x, depth] = band.points[i];
                depths.include(depth);
                seen.include(x / depth);
                seen.include((x - static_cast<double>(rays_.hogels() - 1)) / depth);
            }
            const double* steps = rays_.steps();
            if ((depths.low < margin && depths.high > -margin) || rays_.directions() == 1)
                return {0, rays_.directions()};
            const double step = steps[1] - steps[0];
            return samples_between((seen.low - steps[0]) / step, (seen.high - steps[0]) / step, rays_.directions());
        }

        void draw() {
            draw_bands({bands_.data(), band_count_}, rays_, words_, visits_);
            band_count_ = 0;
        }

        const RowAxes& axes_;
        const SlabRays& rays_;
        std::uint64_t* words_;
        Visits& visits_;
        double per_pitch_, first_row_, first_hogel_;
        std::vector<Band> bands_;  // only the first ones are in use
        std::size_t band_count_ = 0;
    };

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    std::vector<std::uint32_t> with_area_;
    SlabTriangles triangles_;
};

// Memory of a copied triangle (corners and radiance), and, for each region in progress, of its entry in a
// TriangleBlock.
constexpr double bytes_a_slab_triangle = 128, bytes_a_block_triangle = 28;

}  // namespace

RendererInfo simploid_renderer() {
    return {
        .name = "simploid",
        .text = "as simplex, but in slices of whole simploids, one row of directions after the other",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<SimploidRenderer>(std::move(scene), grid); },
        .cost =
            [](const LightFieldGrid& grid, const HogelRange& region, std::size_t triangles) {
                const double rows = bytes_a_block_triangle * static_cast<double>(triangles);
                return RenderCost{.bytes = buffer_bytes(simploid_buffer(RowAxes(grid), region)) + rows,
                                  .bytes_a_triangle = bytes_a_slab_triangle};
            }};
}

}  // namespace hogel::simplex
