// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/baselines/mvr.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/stop_scope.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/row_axes.h"
#include "hogel/render/row_tile.h"
#include "hogel/render/span.h"
#include "hogel/render/visits.h"

namespace hogel::render::baselines {
namespace {

struct Interval {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

// Part of a triangle that the rays of one t and one V can see. Usually it is a segment between two corners in the plane
// (x, ζ) of these rays; if the triangle nearly lies in the plane it has more corners. On a side of a hemicube ζ is the
// forward distance, and on the left and right x, t and V are exchanged with y, s and U.
struct Slice {
    std::uint32_t triangle = 0, corners = 0;
    std::array<double, 5> x{}, depth{};  // at most two crossings of edges and three vertices

    void include(double corner_x, double corner_depth) {
        x[corners] = corner_x;
        depth[corners] = corner_depth;
        ++corners;
    }
};

class MvrRenderer final : public Renderer, public CountsVisits {
  public:
    MvrRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid), axes_(grid) {
        MvrRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    HogelRange preferred_tile() const override { return row_tile(grid_, axes_.transposed()); }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        scene_ = std::move(scene);
        triangles_ = triangles_with_area(*scene_, std::move(triangles_));
    }

    // Source: [K] fig. 5.8.
    void read(LightFieldTile& tile) const override {
        const std::size_t hogels = axes_.fast_hogels(tile.range);
        std::vector<std::vector<Slice>> tables(axes_.slow_directions());
        Array<NearestTriangle, 2> picture({axes_.fast_directions(), hogels});
        Visits visits;
        for (std::size_t row = 0; row < axes_.slow_hogels(tile.range); ++row) {
            const double slow_hogel = axes_.slow_hogel(tile.range, row);
            for (std::vector<Slice>& table : tables) table.clear();
            for (std::uint32_t index : triangles_) slice_triangle(index, slow_hogel, tables);
            for (std::size_t slow = 0; slow < tables.size(); ++slow) {
                core::throw_if_stopped();
                std::ranges::fill(picture.elements(), NearestTriangle{});
                for (const Slice& slice : tables[slow]) scan_convert(slice, slow, row, tile.range, picture, visits);
                for (std::size_t i = 0; i < hogels; ++i)
                    for (std::size_t fast = 0; fast < axes_.fast_directions(); ++fast) {
                        const auto [t, s, v, u] = axes_.sample(row, i, slow, fast);
                        store(tile, *scene_, grid_, picture(fast, i), t, s, v, u);
                    }
            }
        }
        add_visits(visits);
    }

  private:
    std::array<RowAxes::Seen, 3> corners(std::uint32_t index, double slow_hogel) const {
        const auto& [a, b, c] = scene_->triangles[index].vertices;
        return {axes_.seen(scene_->positions[a], slow_hogel), axes_.seen(scene_->positions[b], slow_hogel),
                axes_.seen(scene_->positions[c], slow_hogel)};
    }

    // Returns whether points are too close to the hologram plane for a well-defined direction.
    bool touches_hologram(const Interval& depth) const {
        const double margin = 1e-3 * grid_.pitch;
        return depth.low < margin && depth.high > -margin;
    }

    // Returns the rows of directions in which a row of hogels sees a triangle.
    Span rows(const std::array<RowAxes::Seen, 3>& triangle) const {
        Interval row, depth;
        for (const RowAxes::Seen& p : triangle) {
            depth.include(p.forward);
            row.include(axes_.slow_index(p.slow / p.forward));
        }
        if (touches_hologram(depth)) return {0, axes_.slow_directions()};
        return samples_between(row.low, row.high, axes_.slow_directions());
    }

    void slice_triangle(std::uint32_t index, double slow_hogel, std::vector<std::vector<Slice>>& tables) const {
        const std::array<RowAxes::Seen, 3> triangle = corners(index, slow_hogel);
        const double margin = scan_margin * grid_.pitch;
        const Span visible = rows(triangle);
        for (std::size_t v = visible.first; v < visible.end; ++v) {
            // Heights of the corners above the plane y = t + Vζ of the rays.
            std::array<double, 3> height;
            for (std::size_t i = 0; i < 3; ++i)
                height[i] = triangle[i].slow - axes_.slow_direction(v) * triangle[i].forward;
            Slice slice{index};
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3;
                const RowAxes::Seen &a = triangle[i], &b = triangle[j];
                if (std::abs(height[i]) <= margin) slice.include(a.fast, a.forward);
                if ((height[i] < 0) == (height[j] < 0) || height[i] == 0 || height[j] == 0) continue;
                const double f = height[i] / (height[i] - height[j]);
                slice.include(a.fast + f * (b.fast - a.fast), a.forward + f * (b.forward - a.forward));
            }
            if (slice.corners > 0) tables[v].push_back(slice);
        }
    }

    // Draws a slice's track. For each U the slice covers s from the smallest to the largest x − Uζ of its corners.
    void scan_convert(const Slice& slice, std::size_t slow, std::size_t row, const HogelRange& range,
                      Array<NearestTriangle, 2>& picture, Visits& visits) const {
        ++visits.pieces;
        const std::size_t count = axes_.fast_hogels(range);
        const double first = axes_.fast_hogel(range, 0);
        const Span columns = columns_of_directions(slice, first, axes_.fast_hogel(range, count - 1));
        for (std::size_t fast = columns.first; fast < columns.end; ++fast) {
            const double U = axes_.fast_direction(fast);
            Interval s;
            for (std::size_t i = 0; i < slice.corners; ++i)
                s.include(axes_.fast_sign() * (slice.x[i] - U * slice.depth[i] - first) / grid_.pitch);
            const Span hogels = samples_between(s.low, s.high, count);
            if (hogels.first == hogels.end) continue;
            ++visits.slices;
            visits.samples += hogels.size();
            const auto [t0, s0, v, u] = axes_.sample(row, 0, slow, fast);
            const ObliqueTriangle triangle(*scene_, slice.triangle, grid_, static_cast<double>(u),
                                           static_cast<double>(v));
            for (std::size_t i = hogels.first; i < hogels.end; ++i) {
                const std::size_t along_s = axes_.transposed() ? 0 : i, along_t = axes_.transposed() ? i : 0;
                see(picture(fast, i), slice.triangle, triangle, grid_.s(static_cast<double>(range.s0 + s0 + along_s)),
                    grid_.t(static_cast<double>(range.t0 + t0 + along_t)));
            }
        }
    }

    // Returns the columns of directions in which hogels between two positions see a slice.
    Span columns_of_directions(const Slice& slice, double first, double last) const {
        Interval column, depth;
        for (std::size_t i = 0; i < slice.corners; ++i) {
            depth.include(slice.depth[i]);
            for (double hogel : {first, last}) column.include(axes_.fast_index((slice.x[i] - hogel) / slice.depth[i]));
        }
        if (touches_hologram(depth)) return {0, axes_.fast_directions()};
        return samples_between(column.low, column.high, axes_.fast_directions());
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace

RendererInfo mvr_renderer() {
    return {.name = "mvr",
            .text = "multiple viewpoint rendering: slices of triangles for each row of hogels and of directions",
            .make = [](std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) {
                return std::make_unique<MvrRenderer>(std::move(scene), grid);
            }};
}

}  // namespace hogel::render::baselines
