// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "hogel/core/stop_scope.h"
#include "hogel/render/baselines/oblique.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/region_memory.h"
#include "hogel/render/span.h"
#include "hogel/render/visits.h"

namespace hogel::render::baselines {
namespace {

// Corners of a projected triangle in columns and rows of hogels, relative to the tile's first hogel.
struct TriangleInHogels {
    std::array<double, 3> s, t;

    TriangleInHogels(const ObliqueTriangle& triangle, const LightFieldGrid& grid, const HogelRange& range) {
        const double first_s = grid.s(static_cast<double>(range.s0)), first_t = grid.t(static_cast<double>(range.t0));
        for (std::size_t i = 0; i < 3; ++i) {
            s[i] = (triangle.s()[i] - first_s) / grid.pitch;
            t[i] = (first_t - triangle.t()[i]) / grid.pitch;
        }
    }

    Span rows(std::size_t nt) const {
        const auto [low, high] = std::minmax_element(t.begin(), t.end());
        return samples_between(*low, *high, nt);
    }

    // Returns the columns between the outermost points at which edges cross the row or end within a margin of it.
    Span columns(std::size_t row, std::size_t ns) const {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        const auto include = [&](double column) {
            low = std::min(low, column);
            high = std::max(high, column);
        };
        const double level = static_cast<double>(row);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if (std::abs(t[i] - level) <= scan_margin) include(s[i]);
            if ((t[i] < level && level < t[j]) || (t[j] < level && level < t[i]))
                include(s[i] + (level - t[i]) / (t[j] - t[i]) * (s[j] - s[i]));
        }
        return samples_between(low, high, ns);
    }
};

// Returns the shape of the depth buffer of one direction, [t][s].
Shape<2> oblique_buffer(const HogelRange& region) { return {region.nt, region.ns}; }

class ObliqueRenderer final : public Renderer, public CountsVisits {
  public:
    ObliqueRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid) {
        ObliqueRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        scene_ = std::move(scene);
        triangles_ = triangles_with_area(*scene_, std::move(triangles_));
    }

    void read(LightFieldTile& tile) const override {
        Array<NearestTriangle, 2> picture(oblique_buffer(tile.range));
        Visits visits;
        for (std::size_t v = 0; v < grid_.directions_v; ++v)
            for (std::size_t u = 0; u < grid_.directions_u; ++u) {
                core::throw_if_stopped();
                std::ranges::fill(picture.elements(), NearestTriangle{});
                for (std::uint32_t index : is_ray(v, u) ? std::span(triangles_) : std::span<const std::uint32_t>())
                    scan_convert(ObliqueTriangle(*scene_, index, grid_, static_cast<double>(u), static_cast<double>(v)),
                                 index, tile.range, picture, visits);
                for (std::size_t t = 0; t < tile.range.nt; ++t)
                    for (std::size_t s = 0; s < tile.range.ns; ++s)
                        store(tile, *scene_, grid_, picture(t, s), t, s, v, u);
            }
        add_visits(visits);
    }

  private:
    // The corners of a frequency grid are evanescent.
    bool is_ray(std::size_t v, std::size_t u) const {
        return grid_.direction_of(grid_.u(static_cast<double>(u)), grid_.v(static_cast<double>(v))) != Vec3{};
    }

    void scan_convert(const ObliqueTriangle& triangle, std::uint32_t index, const HogelRange& range,
                      Array<NearestTriangle, 2>& picture, Visits& visits) const {
        const TriangleInHogels in_hogels(triangle, grid_, range);
        const Span rows = in_hogels.rows(range.nt);
        ++visits.pieces;
        visits.slices += rows.size();
        for (std::size_t t = rows.first; t < rows.end; ++t) {
            const Span columns = in_hogels.columns(t, range.ns);
            visits.samples += columns.size();
            for (std::size_t s = columns.first; s < columns.end; ++s)
                see(picture(t, s), index, triangle, grid_.s(static_cast<double>(range.s0 + s)),
                    grid_.t(static_cast<double>(range.t0 + t)));
        }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    std::vector<std::uint32_t> triangles_;
};

// Time for drawing one triangle in units of a ray of `epi`: 40 ns (docs/performance.md).
constexpr double rays_a_drawn_triangle = 21;

}  // namespace

RendererInfo oblique_renderer() {
    return {
        .name = "oblique",
        .text = "for each direction a parallel projection over all hogels of a tile",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<ObliqueRenderer>(std::move(scene), grid); },
        .cost =
            [](const LightFieldGrid& grid, const HogelRange& region, std::size_t triangles) {
                // Each direction draws all triangles, even if there are few hogels.
                const double drawn = static_cast<double>(grid.directions()) * static_cast<double>(triangles);
                return RenderCost{.bytes = buffer_bytes(oblique_buffer(region)), .rays = rays_a_drawn_triangle * drawn};
            },
        .takes_frequencies = true};
}

}  // namespace hogel::render::baselines
