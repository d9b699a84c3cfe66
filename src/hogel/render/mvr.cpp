#include "hogel/render/mvr_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/oblique_triangle_internal.h"
#include "hogel/render/row_tile_internal.h"
#include "hogel/render/span_internal.h"

namespace hogel {
namespace {

struct Interval {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

// What the rays of one t and one V can see of a triangle: the points (x, ζ) in the plane of these rays between some
// corners, two as a rule. A slice is a line of points; a triangle that all but lies in the plane is all of it.
struct Slice {
    std::uint32_t triangle = 0, corners = 0;
    std::array<double, 5> x{}, depth{};  // on two edges at most, and at three vertices

    void include(double corner_x, double corner_depth) {
        x[corners] = corner_x;
        depth[corners] = corner_depth;
        ++corners;
    }
};

class MvrRenderer final : public LightFieldSource {
  public:
    MvrRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), triangles_(triangles_with_area(*scene_)) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    HogelRange preferred_tile() const override { return row_tile(grid_); }

    // Source: [K] fig. 5.8.
    void read(LightFieldTile& tile) const override {
        std::vector<std::vector<Slice>> tables(grid_.directions_v);
        Array<NearestTriangle, 2> picture({grid_.directions_u, tile.range.ns});
        for (std::size_t t = 0; t < tile.range.nt; ++t) {
            const double hogel_t = grid_.t(static_cast<double>(tile.range.t0 + t));
            for (std::vector<Slice>& table : tables) table.clear();
            for (std::uint32_t index : triangles_) slice_triangle(index, hogel_t, tables);
            for (std::size_t v = 0; v < grid_.directions_v; ++v) {
                std::ranges::fill(picture.elements(), NearestTriangle{});
                for (const Slice& slice : tables[v]) scan_convert(slice, v, hogel_t, tile.range, picture);
                for (std::size_t s = 0; s < tile.range.ns; ++s)
                    for (std::size_t u = 0; u < grid_.directions_u; ++u)
                        store(tile, *scene_, grid_, picture(u, s), t, s, v, u);
            }
        }
    }

  private:
    std::array<Vec3, 3> corners(std::uint32_t index) const {
        const auto& [a, b, c] = scene_->triangles[index].vertices;
        return {scene_->positions[a], scene_->positions[b], scene_->positions[c]};
    }

    // Where points have no direction, or rounding makes one up.
    bool touches_hologram(const Interval& depth) const {
        const double least = 1e-3 * grid_.pitch;
        return depth.low < least && depth.high > -least;
    }

    // The rows of directions in which a triangle is seen from row t of hogels.
    Span rows(const std::array<Vec3, 3>& triangle, double hogel_t) const {
        Interval row, depth;
        for (const Vec3& p : triangle) {
            depth.include(-p.z);
            row.include(grid_.row((hogel_t - p.y) / p.z));
        }
        if (touches_hologram(depth)) return {0, grid_.directions_v};
        return samples_between(row.low, row.high, grid_.directions_v);
    }

    void slice_triangle(std::uint32_t index, double hogel_t, std::vector<std::vector<Slice>>& tables) const {
        const std::array<Vec3, 3> triangle = corners(index);
        const double margin = scan_margin * grid_.pitch;
        const Span seen_in = rows(triangle, hogel_t);
        for (std::size_t v = seen_in.first; v < seen_in.end; ++v) {
            // The heights of the corners above the plane y = t + Vζ of the rays.
            std::array<double, 3> height;
            for (std::size_t i = 0; i < 3; ++i)
                height[i] = triangle[i].y - hogel_t + grid_.v(static_cast<double>(v)) * triangle[i].z;
            Slice slice{index};
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3;
                const Vec3 &a = triangle[i], &b = triangle[j];
                if (std::abs(height[i]) <= margin) slice.include(a.x, -a.z);
                if ((height[i] < 0) == (height[j] < 0) || height[i] == 0 || height[j] == 0) continue;
                const double f = height[i] / (height[i] - height[j]);
                slice.include(a.x + f * (b.x - a.x), -a.z - f * (b.z - a.z));
            }
            if (slice.corners > 0) tables[v].push_back(slice);
        }
    }

    // A polygon slice track: for each U the slice covers the s between the places x − Uζ of its corners.
    void scan_convert(const Slice& slice, std::size_t v, double hogel_t, const HogelRange& range,
                      Array<NearestTriangle, 2>& picture) const {
        const double first = grid_.s(static_cast<double>(range.s0));
        const Span columns = columns_of_directions(slice, first, grid_.s(static_cast<double>(range.s0 + range.ns - 1)));
        for (std::size_t u = columns.first; u < columns.end; ++u) {
            const double U = grid_.u(static_cast<double>(u));
            Interval s;
            for (std::size_t i = 0; i < slice.corners; ++i)
                s.include((slice.x[i] - U * slice.depth[i] - first) / grid_.pitch);
            const Span hogels = samples_between(s.low, s.high, range.ns);
            if (hogels.first == hogels.end) continue;
            const ObliqueTriangle triangle(*scene_, slice.triangle, U, grid_.v(static_cast<double>(v)));
            for (std::size_t i = hogels.first; i < hogels.end; ++i)
                see(picture(u, i), slice.triangle, triangle, grid_.s(static_cast<double>(range.s0 + i)), hogel_t);
        }
    }

    // The columns of directions in which a slice is seen from hogels between two s.
    Span columns_of_directions(const Slice& slice, double first, double last) const {
        Interval column, depth;
        for (std::size_t i = 0; i < slice.corners; ++i) {
            depth.include(slice.depth[i]);
            for (double s : {first, last}) column.include(grid_.column((slice.x[i] - s) / slice.depth[i]));
        }
        if (touches_hologram(depth)) return {0, grid_.directions_u};
        return samples_between(column.low, column.high, grid_.directions_u);
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace

std::unique_ptr<LightFieldSource> make_mvr_renderer(std::shared_ptr<const ShadedScene> scene,
                                                    const LightFieldGrid& grid) {
    return std::make_unique<MvrRenderer>(std::move(scene), grid);
}

}  // namespace hogel
