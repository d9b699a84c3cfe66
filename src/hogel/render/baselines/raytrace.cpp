// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "hogel/core/part.h"
#include "hogel/core/stop_scope.h"
#include "hogel/render/baselines/raytrace.h"
#include "hogel/render/sample_store.h"
#include "hogel/shading/triangles.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::render::baselines {
namespace {

// Side of the square of directions traced as one batch; neighbouring rays share most of their path.
constexpr std::size_t bundle = 16;

class RaytraceRenderer final : public Renderer {
  public:
    RaytraceRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) : grid_(grid) {
        RaytraceRenderer::set_scene(std::move(scene));
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        core::require_part("Embree", "the renderer 'raytrace'");
        scene_ = std::move(scene);
        shading::set_seen_triangles(caster_, *scene_);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        low_ = {infinity, infinity, infinity};
        high_ = -low_;
        for (const ShadedScene::Triangle& triangle : scene_->triangles)
            for (std::uint32_t vertex : triangle.vertices) {
                const Vec3& p = scene_->positions[vertex];
                low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, -p.z)};
                high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, -p.z)};
            }
    }

    void read(LightFieldTile& tile) const override {
        for (std::size_t t = 0; t < tile.range.nt; ++t)
            for (std::size_t s = 0; s < tile.range.ns; ++s) {
                core::throw_if_stopped();
                for (std::size_t v0 = 0; v0 < grid_.directions_v; v0 += bundle)
                    for (std::size_t u0 = 0; u0 < grid_.directions_u; u0 += bundle) trace(tile, t, s, v0, u0);
            }
    }

  private:
    // Returns the forward distances at which the rays of a hogel begin and end: slightly in front of the nearest point
    // of the scene and slightly behind the farthest.
    std::pair<double, double> ray_interval(Vec3 hogel) const {
        const double a = to_face(grid_.face(), low_ - hogel).z, b = to_face(grid_.face(), high_ - hogel).z;
        const double low = std::min(a, b), high = std::max(a, b), margin = 1e-3 * (high - low) + 1e-9;
        return {low - margin, high + margin};
    }

    void trace(LightFieldTile& tile, std::size_t t, std::size_t s, std::size_t v0, std::size_t u0) const {
        const std::size_t nv = std::min(bundle, grid_.directions_v - v0),
                          nu = std::min(bundle, grid_.directions_u - u0);
        const Vec3 hogel{grid_.s(static_cast<double>(tile.range.s0 + s)),
                         grid_.t(static_cast<double>(tile.range.t0 + t)), 0};
        const LightFieldGrid grid =
            grid_.of_hogel(static_cast<double>(tile.range.s0 + s), static_cast<double>(tile.range.t0 + t));
        const auto [near, far] = ray_interval(hogel);
        std::array<Vec3, bundle * bundle> origins, directions;
        std::array<trace::RayHit, bundle * bundle> hits;
        for (std::size_t v = 0; v < nv; ++v)
            for (std::size_t u = 0; u < nu; ++u) {
                const Vec3 direction =
                    grid.direction_of(grid.u(static_cast<double>(u0 + u)), grid.v(static_cast<double>(v0 + v)));
                const Vec3 start = hogel + direction * near;
                // z = −ζ. The direction has a forward component of 1, so the ray parameter is the forward distance.
                origins[v * nu + u] = {start.x, start.y, -start.z};
                directions[v * nu + u] = {direction.x, direction.y, -direction.z};
            }
        const std::size_t n = nv * nu;
        caster_.closest(std::span(origins).first(n), std::span(directions).first(n), far - near,
                        std::span(hits).first(n));
        for (std::size_t v = 0; v < nv; ++v)
            for (std::size_t u = 0; u < nu; ++u) {
                const trace::RayHit& hit = hits[v * nu + u];
                VisiblePoint point;
                const bool is_ray = directions[v * nu + u].z != 0;  // the corners of a frequency grid are evanescent
                if (is_ray && hit.triangle != trace::RayHit::miss)
                    point = {hit.triangle, 1 - hit.b1 - hit.b2, hit.b1, hit.b2,
                             -directions[v * nu + u].z * (near + hit.distance)};
                store(tile, *scene_, grid, point, t, s, v0 + v, u0 + u);
            }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    trace::RayCaster caster_;
    Vec3 low_, high_;  // bounding box of the scene in (x, y, ζ)
};

}  // namespace

RendererInfo raytrace_renderer() {
    return {
        .name = "raytrace",
        .text = "one ray a sample through a bounding volume hierarchy (Embree)",
        .make = [](std::shared_ptr<const ShadedScene> scene,
                   const LightFieldGrid& grid) { return std::make_unique<RaytraceRenderer>(std::move(scene), grid); },
        .casts_rays = true,
        .takes_frequencies = true,
        .takes_focal_plane = true};
}

}  // namespace hogel::render::baselines
