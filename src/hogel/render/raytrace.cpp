#include <algorithm>
#include <array>
#include <vector>

#include "hogel/render/raytrace_internal.h"
#include "hogel/render/sample_store_internal.h"
#include "hogel/trace/ray_caster.h"

namespace hogel {
namespace {

// Neighbouring directions travel together: the rays of a square of this side share most of their way through the tree.
constexpr std::size_t bundle = 16;

class RaytraceRenderer final : public LightFieldSource {
  public:
    RaytraceRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), caster_(scene_->positions, triangles(*scene_)) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const ShadedScene::Triangle& triangle : scene_->triangles)
            for (std::uint32_t vertex : triangle.vertices) {
                low = std::min(low, -scene_->positions[vertex].z);
                high = std::max(high, -scene_->positions[vertex].z);
            }
        // Rays start a little in front of the nearest point and end a little behind the farthest.
        const double margin = 1e-3 * (high - low) + 1e-9;
        near_ = low - margin;
        far_ = high + margin;
    }

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return true; }

    void read(LightFieldTile& tile) const override {
        for (std::size_t t = 0; t < tile.range.nt; ++t)
            for (std::size_t s = 0; s < tile.range.ns; ++s)
                for (std::size_t v0 = 0; v0 < grid_.directions_v; v0 += bundle)
                    for (std::size_t u0 = 0; u0 < grid_.directions_u; u0 += bundle) trace(tile, t, s, v0, u0);
    }

  private:
    static std::vector<std::array<std::uint32_t, 3>> triangles(const ShadedScene& scene) {
        std::vector<std::array<std::uint32_t, 3>> list;
        list.reserve(scene.triangles.size());
        for (const ShadedScene::Triangle& triangle : scene.triangles) list.push_back(triangle.vertices);
        return list;
    }

    void trace(LightFieldTile& tile, std::size_t t, std::size_t s, std::size_t v0, std::size_t u0) const {
        const std::size_t nv = std::min(bundle, grid_.directions_v - v0),
                          nu = std::min(bundle, grid_.directions_u - u0);
        const double hogel_s = grid_.s(static_cast<double>(tile.range.s0 + s));
        const double hogel_t = grid_.t(static_cast<double>(tile.range.t0 + t));
        std::array<Vec3, bundle * bundle> origins, directions;
        std::array<RayHit, bundle * bundle> hits;
        // x = s + Uζ, y = t + Vζ, z = −ζ: with direction (U, V, −1) the distance along the ray is ζ − near.
        for (std::size_t v = 0; v < nv; ++v)
            for (std::size_t u = 0; u < nu; ++u) {
                const double U = grid_.u(static_cast<double>(u0 + u)), V = grid_.v(static_cast<double>(v0 + v));
                origins[v * nu + u] = {hogel_s + U * near_, hogel_t + V * near_, -near_};
                directions[v * nu + u] = {U, V, -1};
            }
        const std::size_t n = nv * nu;
        caster_.closest(std::span(origins).first(n), std::span(directions).first(n), far_ - near_,
                        std::span(hits).first(n));
        for (std::size_t v = 0; v < nv; ++v)
            for (std::size_t u = 0; u < nu; ++u) {
                const RayHit& hit = hits[v * nu + u];
                VisiblePoint point;
                if (hit.triangle != RayHit::miss)
                    point = {hit.triangle, 1 - hit.b1 - hit.b2, hit.b1, hit.b2, near_ + hit.distance};
                store(tile, *scene_, grid_, point, t, s, v0 + v, u0 + u);
            }
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    RayCaster caster_;
    double near_ = 0, far_ = 0;  // ζ
};

}  // namespace

std::unique_ptr<LightFieldSource> make_raytrace_renderer(std::shared_ptr<const ShadedScene> scene,
                                                         const LightFieldGrid& grid) {
    return std::make_unique<RaytraceRenderer>(std::move(scene), grid);
}

}  // namespace hogel
