// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/simplex/simploid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hogel/core/parallel.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/region_memory.h"
#include "hogel/render/row_axes.h"
#include "hogel/render/span.h"
#include "hogel/render/visits.h"

namespace hogel::render::simplex {
namespace {

// A point (x, ζ) in the plane of the rays of one t and one V: x as a column of hogels relative to the tile's first, and
// the depth in hogels, which is the shift of x for U = 1.
struct SegmentPoint {
    double x = 0, depth = 0;
};

// The part of a triangle that the rays of one t and one V can see, usually the segment between the points where two
// edges cross their plane. In the plane (s, U) each point is a line, and the segment is the band between two lines.
struct Segment {
    std::array<SegmentPoint, 5> points;  // at most two crossings of edges and three vertices
    std::size_t count = 0;

    void include(SegmentPoint p) { points[count++] = p; }
};

// The corners of a triangle projected along the directions of one V: for each the row of hogels that sees it, and x and
// ζ.
struct ProjectedTriangle {
    std::array<double, 3> row;
    std::array<SegmentPoint, 3> at;

    // The points where edges cross a row, and corners within the margin of it.
    Segment slice(double level) const {
        Segment segment;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = i == 2 ? 0 : i + 1;
            if (std::abs(row[i] - level) <= scan_margin) segment.include(at[i]);
            if ((row[i] < level && level < row[j]) || (row[j] < level && level < row[i])) {
                const double part = (level - row[i]) / (row[j] - row[i]);
                segment.include(
                    {at[i].x + part * (at[j].x - at[i].x), at[i].depth + part * (at[j].depth - at[i].depth)});
            }
        }
        return segment;
    }
};

// In this file t and V stand for the slow axis of RowAxes, s and U for the fast one: on the left and right of a
// hemicube they are s, U, t and V.
class SimploidRenderer final : public Renderer, public CountsVisits {
  public:
    SimploidRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid), axes_(grid) {
        SimploidRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        scene_ = std::move(scene);
        triangles_ = triangles_with_area(*scene_, std::move(triangles_));
    }

    void read(LightFieldTile& tile) const override {
        const std::size_t rows = axes_.slow_hogels(tile.range), hogels = axes_.fast_hogels(tile.range);
        const std::size_t directions = axes_.fast_directions();
        // Processes one V at a time, so that neighbouring triangles write to neighbouring memory.
        Array<NearestTriangle, 3> buffer(simploid_buffer(axes_, tile.range));
        Visits visits;
        const std::vector<Directions> seen_in = slow_directions_of_triangles(tile.range);
        for (std::size_t slow = 0; slow < axes_.slow_directions(); ++slow) {
            core::throw_if_stopped();
            std::ranges::fill(buffer.elements(), NearestTriangle{});
            const Slab slab(*this, tile.range, slow);
            for (std::size_t i = 0; i < triangles_.size(); ++i)
                if (seen_in[i].first <= slow && slow < seen_in[i].end) slab.scan_convert(triangles_[i], buffer, visits);
            for (std::size_t row = 0; row < rows; ++row)
                for (std::size_t i = 0; i < hogels; ++i)
                    for (std::size_t fast = 0; fast < directions; ++fast) {
                        const auto [t, s, v, u] = axes_.sample(row, i, slow, fast);
                        store(tile, *scene_, grid_, buffer(row, i, fast), t, s, v, u);
                    }
        }
        add_visits(visits);
    }

  private:
    // Rows of directions, along the slow axis: first <= V < end.
    struct Directions {
        std::uint32_t first = 0, end = 0;
    };

    // dx/dζ or dy/dζ along the slow axis of the rays of one V.
    double slow_slope(std::size_t slow) const {
        const auto [t, s, v, u] = axes_.sample(0, 0, slow, 0);
        const Vec3 direction = grid_.direction_of(grid_.u(static_cast<double>(u)), grid_.v(static_cast<double>(v)));
        return (axes_.transposed() ? direction.x : direction.y) / direction.z;
    }

    // The V in which hogels of a region may see each triangle. Slopes (y − t)/ζ of lines from a triangle to a row of
    // hogels are extreme at corners and at the first and last row; all may be seen of what comes close to the hologram.
    std::vector<Directions> slow_directions_of_triangles(const HogelRange& range) const {
        const std::size_t count = axes_.slow_directions();
        std::vector<double> slopes(count);
        for (std::size_t slow = 0; slow < count; ++slow) slopes[slow] = slow_slope(slow);
        const bool rising = slopes.front() <= slopes.back();
        const double from = axes_.slow_hogel(range, 0), to = axes_.slow_hogel(range, axes_.slow_hogels(range) - 1);
        const double near = 1e-3 * grid_.pitch, margin = 1e-4 * grid_.pitch;
        std::vector<Directions> seen(triangles_.size(), {0, static_cast<std::uint32_t>(count)});
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            double low = std::numeric_limits<double>::infinity(), high = -low, shallow = low, deep = high;
            for (const std::uint32_t vertex : scene_->triangles[triangles_[i]].vertices) {
                const Vec3& p = scene_->positions[vertex];
                const double slow = axes_.transposed() ? p.x : p.y, a = (slow - from) / -p.z, b = (slow - to) / -p.z;
                low = std::min({low, a, b});
                high = std::max({high, a, b});
                shallow = std::min(shallow, -p.z);
                deep = std::max(deep, -p.z);
            }
            if (shallow < near && deep > -near) continue;
            const double wider = margin / std::min(std::abs(shallow), std::abs(deep));
            const auto before = [&](double slope) { return rising ? slope < low - wider : slope > high + wider; };
            const auto not_beyond = [&](double slope) { return rising ? slope <= high + wider : slope >= low - wider; };
            const auto first = std::ranges::partition_point(slopes, before),
                       end = std::partition_point(first, slopes.end(), not_beyond);
            seen[i] = {static_cast<std::uint32_t>(first - slopes.begin()),
                       static_cast<std::uint32_t>(end - slopes.begin())};
        }
        return seen;
    }

    // The rays of a tile with one V.
    class Slab {
      public:
        Slab(const SimploidRenderer& renderer, const HogelRange& range, std::size_t slow)
            : scene_(*renderer.scene_), grid_(renderer.grid_), axes_(renderer.axes_), range_(range), slow_(slow) {
            const double pitch = grid_.pitch;
            for (std::size_t k = 0; k < axes_.fast_directions(); ++k) {
                const auto [t, s, v, u] = axes_.sample(0, 0, slow, k);
                const Vec3 direction =
                    grid_.direction_of(grid_.u(static_cast<double>(u)), grid_.v(static_cast<double>(v)));
                slopes_.push_back({direction.x / direction.z, direction.y / direction.z});
                // The slope along the fast axis; that along the slow one is the same for all k.
                fast_slopes_.push_back((axes_.transposed() ? slopes_[k].y : slopes_[k].x) * axes_.fast_sign());
            }
            slow_slope_ = renderer.slow_slope(slow);
            per_pitch_ = 1 / pitch;
            first_row_ = axes_.slow_hogel(range, 0) / pitch;
            first_hogel_ = axes_.fast_hogel(range, 0) / pitch * axes_.fast_sign();
            rows_ = axes_.slow_hogels(range);
            hogels_ = axes_.fast_hogels(range);
        }

        void scan_convert(std::uint32_t index, Array<NearestTriangle, 3>& buffer, Visits& visits) const {
            ++visits.pieces;
            const ProjectedTriangle triangle = project(index);
            const auto [low, high] = std::minmax({triangle.row[0], triangle.row[1], triangle.row[2]});
            const Span rows = samples_between(low, high, rows_);
            for (std::size_t row = rows.first; row < rows.end; ++row) {
                const Segment segment = triangle.slice(static_cast<double>(row));
                if (segment.count > 0) scan_convert(index, segment, row, buffer[row], visits);
            }
        }

      private:
        ProjectedTriangle project(std::uint32_t index) const {
            ProjectedTriangle projected;
            const auto& vertices = scene_.triangles[index].vertices;
            const double row_sign = -axes_.fast_sign();  // t is counted downwards, s to the right
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3& p = scene_.positions[vertices[i]];
                const double depth = -p.z * per_pitch_;
                const double fast = (axes_.transposed() ? p.y : p.x) * per_pitch_;
                const double slow = (axes_.transposed() ? p.x : p.y) * per_pitch_;
                projected.row[i] = row_sign * (slow - slow_slope_ * depth - first_row_);
                projected.at[i] = {axes_.fast_sign() * fast - first_hogel_, depth};
            }
            return projected;
        }

        void scan_convert(std::uint32_t index, const Segment& segment, std::size_t row, View<NearestTriangle, 2> buffer,
                          Visits& visits) const {
            const Span columns = columns_of_directions(segment);
            for (std::size_t k = columns.first; k < columns.end; ++k) {
                double low = std::numeric_limits<double>::infinity(), high = -low;
                for (std::size_t i = 0; i < segment.count; ++i) {
                    const double s = segment.points[i].x - fast_slopes_[k] * segment.points[i].depth;
                    low = std::min(low, s);
                    high = std::max(high, s);
                }
                const Span hogels = samples_between(low, high, hogels_);
                if (hogels.first == hogels.end) continue;
                ++visits.slices;
                visits.samples += hogels.size();
                const ObliqueTriangle triangle(scene_, index, slopes_[k].x, slopes_[k].y);
                for (std::size_t i = hogels.first; i < hogels.end; ++i) {
                    const auto [at_t, at_s, at_v, at_u] = axes_.sample(row, i, slow_, k);
                    see(buffer(i, k), index, triangle, grid_.s(static_cast<double>(range_.s0 + at_s)),
                        grid_.t(static_cast<double>(range_.t0 + at_t)));
                }
            }
        }

        // The directions in which hogels of the tile may see a segment: all if it comes close to the hologram plane,
        // where directions are undefined.
        Span columns_of_directions(const Segment& segment) const {
            constexpr double margin = 1e-3, infinity = std::numeric_limits<double>::infinity();
            double low = infinity, high = -infinity, shallow = infinity, deep = -infinity;
            for (std::size_t i = 0; i < segment.count; ++i) {
                const auto [x, depth] = segment.points[i];
                shallow = std::min(shallow, depth);
                deep = std::max(deep, depth);
                const double from = x / depth, to = (x - static_cast<double>(hogels_ - 1)) / depth;
                low = std::min({low, from, to});
                high = std::max({high, from, to});
            }
            if ((shallow < margin && deep > -margin) || fast_slopes_.size() == 1) return {0, fast_slopes_.size()};
            const double step = fast_slopes_[1] - fast_slopes_[0];
            return samples_between((low - fast_slopes_[0]) / step, (high - fast_slopes_[0]) / step,
                                   fast_slopes_.size());
        }

        const ShadedScene& scene_;
        const LightFieldGrid& grid_;
        const RowAxes& axes_;
        const HogelRange& range_;
        std::size_t slow_;
        std::size_t rows_ = 0, hogels_ = 0;
        double first_row_ = 0, first_hogel_ = 0, slow_slope_ = 0, per_pitch_ = 0;
        struct Slopes {
            double x, y;  // dx/dζ and dy/dζ
        };
        std::vector<Slopes> slopes_;
        std::vector<double> fast_slopes_;
    };

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RowAxes axes_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace

RendererInfo simploid_renderer() {
    return {
        .name = "simploid",
        .text = "as simplex, but in slices of whole simploids, one row of directions after the other",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<SimploidRenderer>(std::move(scene), grid); },
        .depth_buffer_bytes =
            [](const LightFieldGrid& grid, const HogelRange& region) {
                return buffer_bytes(simploid_buffer(RowAxes(grid), region));
            }};
}

}  // namespace hogel::render::simplex
