// SPDX-License-Identifier: Apache-2.0
// [K] chapter 5, unmodified: depth and shading are interpolated in four dimensions between the corners of the projected
// volume; `simplex` computes both from the ray and the triangle.
#include "thesis/simplex/interpolated.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/visits.h"
#include "hogel/shading/radiance_at.h"
#include "thesis/simplex/rays_in_blocks.h"
#include "thesis/simplex/scan.h"
#include "thesis/simplex/seen_directions.h"
#include "thesis/simplex/slice.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

using namespace render;

namespace {

// Coordinates of a ProjectedPoint, then values times Q: radiance without texture, weights of the second and third
// vertex. [K] also interpolates Z = (ζ − ζ_n)/ζ = 1 − ζ_n Q, which orders depths as Q does.
namespace value {
enum : std::size_t { red = 5, green, blue, weight1, weight2, count };
}
using ShadedPoint = std::array<double, value::count>;
using ShadedSlice = std::array<ShadedPoint, 3>;

// Element of the depth and colour buffers of [K] fig. 5.21.
struct BufferedSample {
    float depth = std::numeric_limits<float>::infinity();
    Rgb radiance;
};

// Hogels of a region to be rendered, relative to its first hogel.
struct Part {
    Span rows, columns;
};

// Returns the whole numbers i with low <= i < high of a span, so that slices that share an edge share no sample.
Span half_open(double low, double high, const Span& range) {
    const auto bound = [&](double x) {
        return static_cast<std::size_t>(
            std::clamp(std::ceil(x), static_cast<double>(range.first), static_cast<double>(range.end)));
    };
    const Span span{bound(low), bound(high)};
    return span.first < span.end ? span : Span{};
}

class InterpolatingRenderer final : public Renderer, public CountsVisits {
  public:
    InterpolatingRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid, std::size_t region)
        : grid_(grid), region_(region) {
        require_perspective(grid, ErrorCode::usage, "interpolation between viewpoints");
        if (grid.face() != Face::front)
            throw Error(ErrorCode::usage, "interpolate",
                        "interpolation between viewpoints is for the front face alone");
        if (region == 0)
            throw Error(ErrorCode::usage, "interpolate", "interpolation needs regions of one hogel or more");
        InterpolatingRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }
    HogelRange preferred_tile() const override {
        return {0, 0, std::min(region_, grid_.hogels_s), std::min(region_, grid_.hogels_t)};
    }
    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        near_plane(*scene, "simplex");  // throws unless the scene is entirely behind the hologram
        scene_ = std::move(scene);
        triangles_ = triangles_with_area(*scene_, std::move(triangles_));
    }

    // Regions begin at multiples of their side, so that values do not depend on the tile.
    void read(LightFieldTile& tile) const override {
        const HogelRange& r = tile.range;
        for (std::size_t t = r.t0 / region_ * region_; t < r.t0 + r.nt; t += region_)
            for (std::size_t s = r.s0 / region_ * region_; s < r.s0 + r.ns; s += region_)
                read_region({s, t, std::min(region_, grid_.hogels_s - s), std::min(region_, grid_.hogels_t - t)}, tile);
    }

  private:
    // Source: [K] fig. 5.21.
    void read_region(const HogelRange& region, LightFieldTile& tile) const {
        const HogelRange& r = tile.range;
        const auto overlap = [](std::size_t first, std::size_t count, std::size_t from, std::size_t to) {
            return Span{std::max(first, from) - first, std::min(first + count, to) - first};
        };
        const Part part{overlap(region.t0, region.nt, r.t0, r.t0 + r.nt),
                        overlap(region.s0, region.ns, r.s0, r.s0 + r.ns)};
        Array<BufferedSample, 4> buffer(
            {grid_.directions_v, grid_.directions_u, part.rows.size(), part.columns.size()});
        for (BufferedSample& sample : buffer.elements()) sample.radiance = scene_->background;
        SeenDirections visible(grid_);
        Visits visits;
        for (const std::uint32_t index : triangles_) {
            core::throw_if_stopped();
            const DeepTriangle triangle = deep_triangle(*scene_, index);
            if (!visible.find(triangle, region)) continue;
            const RegionSides sides = split_at_back_face(triangle, grid_, region);
            draw(index, triangle, sides.front, region, part, visible, buffer, visits);
            if (!scene_->fronts_only) draw(index, triangle, sides.back, region, part, visible, buffer, visits);
        }
        add_visits(visits);
        for_each_ray(grid_, part.rows, part.columns, [&](std::size_t t, std::size_t s, std::size_t v, std::size_t u) {
            const BufferedSample& sample = buffer(v, u, t - part.rows.first, s - part.columns.first);
            store(tile, sample.radiance, sample.depth, region.t0 + t - r.t0, region.s0 + s - r.s0, v, u);
        });
    }

    // Returns the corners of a triangle seen from a point of the camera plane, with their radiance towards it.
    // Source: [K] (5.2), 5.7.1.
    std::array<ShadedPoint, 3> shaded_corners(std::uint32_t index, const DeepTriangle& triangle, CameraPoint camera,
                                              const HogelRange& region) const {
        const auto projected = project(triangle, camera, grid_, region);
        const double s = grid_.s(static_cast<double>(region.s0) + camera.s);
        const double t = grid_.t(static_cast<double>(region.t0) + camera.t);
        std::array<ShadedPoint, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [x, y, depth] = triangle[i];
            std::array<float, 3> weights{};
            weights[i] = 1;
            ViewSample view;
            if (scene_->needs_samples(index)) view = view_sample(grid_, (x - s) / depth, (y - t) / depth, depth);
            const Rgb radiance = shading::untextured_radiance_at(*scene_, index, weights, view);
            const double q = projected[i][axis::q];
            std::ranges::copy(projected[i], corners[i].begin());
            corners[i][value::red] = q * static_cast<double>(radiance.r);
            corners[i][value::green] = q * static_cast<double>(radiance.g);
            corners[i][value::blue] = q * static_cast<double>(radiance.b);
            corners[i][value::weight1] = i == 1 ? q : 0;
            corners[i][value::weight2] = i == 2 ? q : 0;
        }
        return corners;
    }

    // Scan converts a triangle seen from a convex part of the region. Source: [K] 5.6.1, 5.7.3.
    void draw(std::uint32_t index, const DeepTriangle& triangle, const std::vector<CameraPoint>& seen_from,
              const HogelRange& region, const Part& part, const SeenDirections& visible,
              Array<BufferedSample, 4>& buffer, Visits& visits) const {
        if (seen_from.size() < 3) return;
        std::vector<std::array<ShadedPoint, 3>> corners;
        for (const CameraPoint& camera : seen_from) corners.push_back(shaded_corners(index, triangle, camera, region));
        // Triangles that share an edge divide their common face in the same way if they order its ends in the same way.
        const auto& vertices = scene_->triangles[index].vertices;
        std::array<std::size_t, 3> order{0, 1, 2};
        std::ranges::sort(order, {}, [&](std::size_t i) { return vertices[i]; });
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const std::array<std::size_t, 3> from{0, i - 1, i};
            for (const auto& path : product_paths<5>(2)) {
                std::array<ShadedPoint, 5> simplex;
                for (std::size_t k = 0; k < 5; ++k) simplex[k] = corners[from[path[k].first]][order[path[k].second]];
                ++visits.pieces;
                slice_at_samples(simplex, axis::v, visible.v(), [&](double v, const auto& at_v) {
                    ++visits.cuts;
                    slice_at_samples(at_v, axis::u, visible.u(), [&](double u, const ShadedSlice& slice) {
                        ++visits.cuts;
                        scan_convert(index, slice, u, v, part,
                                     buffer[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)], visits);
                    });
                });
            }
        }
    }

    // Source: [K] 5.7.4.
    void scan_convert(std::uint32_t index, ShadedSlice slice, double u, double v, const Part& part,
                      View<BufferedSample, 2> hogels, Visits& visits) const {
        const auto t_of = [](const ShadedPoint& p) { return p[axis::t] / p[axis::q]; };
        std::ranges::sort(slice, [&](const ShadedPoint& a, const ShadedPoint& b) {
            return t_of(a) != t_of(b) ? t_of(a) < t_of(b) : a < b;
        });
        const std::array t{t_of(slice[0]), t_of(slice[1]), t_of(slice[2])};
        const Span rows = half_open(t[0], t[2], part.rows);
        if (rows.size() > 0) ++visits.slices;
        for (std::size_t row = rows.first; row < rows.end; ++row) {
            const auto level = static_cast<double>(row);
            const double across = crossing(slice[0], slice[2], level);
            const double across_end =
                level < t[1] ? crossing(slice[0], slice[1], level) : crossing(slice[1], slice[2], level);
            const Span columns = half_open(std::min(across, across_end), std::max(across, across_end), part.columns);
            visits.samples += columns.size();
            for (std::size_t column = columns.first; column < columns.end; ++column)
                update(index, slice, static_cast<double>(column), level, u, v,
                       hogels(row - part.rows.first, column - part.columns.first));
        }
    }

    // Replaces a sample by the point of a slice that hogel (s, t) sees, if it is nearer. Source: [K] 5.7.4, the last
    // equations.
    void update(std::uint32_t index, const ShadedSlice& slice, double s, double t, double u, double v,
                BufferedSample& sample) const {
        std::array<double, 3> across, down;  // s' and t'
        for (std::size_t i = 0; i < 3; ++i) {
            across[i] = slice[i][axis::s] - s * slice[i][axis::q];
            down[i] = slice[i][axis::t] - t * slice[i][axis::q];
        }
        std::array a{down[1] * across[2] - down[2] * across[1], down[2] * across[0] - down[0] * across[2],
                     down[0] * across[1] - down[1] * across[0]};
        const double sum = a[0] + a[1] + a[2];
        if (sum == 0) return;
        for (double& weight : a) weight /= sum;
        const auto interpolated = [&](std::size_t coordinate) {
            return a[0] * slice[0][coordinate] + a[1] * slice[1][coordinate] + a[2] * slice[2][coordinate];
        };
        const double depth = 1 / interpolated(axis::q);
        const auto nearer = static_cast<float>(depth);
        if (!(nearer < sample.depth)) return;
        const auto value_at = [&](std::size_t coordinate) {
            return static_cast<float>(depth * interpolated(coordinate));
        };
        sample = {nearer, {value_at(value::red), value_at(value::green), value_at(value::blue)}};
        if (scene_->triangles[index].texture == ShadedScene::no_texture) return;
        const float b1 = value_at(value::weight1), b2 = value_at(value::weight2);
        const ViewSample view = view_sample(grid_, grid_.u(u), grid_.v(v), depth);
        sample.radiance = sample.radiance * shading::texture_at(*scene_, index, 1 - b1 - b2, b1, b2, view);
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    std::size_t region_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace

std::unique_ptr<Renderer> interpolating_renderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid,
                                                 std::size_t region) {
    return std::make_unique<InterpolatingRenderer>(std::move(scene), grid, region);
}

}  // namespace hogel::simplex
