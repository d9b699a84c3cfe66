// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/projected.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "hogel/render/oblique_triangle.h"
#include "hogel/render/sample_store.h"
#include "hogel/shading/radiance_cache.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

// Minimum w of a point. Points nearer to the focal plane would be projected too far away for floats.
constexpr double min_w = 1e-6;

// Return w of a point at depth ζ, and the depth ζ of a point with its projection at depth ζ/w.
double w_at(double depth, double focal) { return 1 - depth / focal; }
double depth_of_projection(double projected, double focal) { return projected / (1 + projected / focal); }

// Source of the light of a projected triangle. These are the meshes of the projected scene.
enum LightAt : std::uint32_t {
    vertices,  // interpolated between the vertices
    cached,    // in a radiance cache
    samples,   // at every ray
};

// Maximum distance between a point of a triangle and the projected point with the same weights, as a fraction of a
// sample's width. Applies where light is interpolated between vertices.
constexpr double max_shift = 0.01;

// Returns an upper bound of the distance in metres: d/4 times the length of an edge with w and w (1 + d) at its ends.
double shift(const ShadedScene& scene, std::size_t index, double focal) {
    const auto [a, b, c] = corners_of(scene, index);
    const auto [low, high] = std::minmax({w_at(-a.z, focal), w_at(-b.z, focal), w_at(-c.z, focal)});
    return 0.25 * (high - low) / low * std::max({length(b - a), length(c - b), length(a - c)});
}

// Returns the smallest width of a sample on a triangle in metres, as in cache_spacing().
double width_of_samples(const ShadedScene& scene, std::size_t index, const LightFieldGrid& grid) {
    const auto [a, b, c] = corners_of(scene, index);
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    return std::max(grid.pitch, std::max({low, -high, 0.0}) * std::max(grid.step_u(), grid.step_v()));
}

LightAt light_at(const ShadedScene& scene, std::size_t index, const LightFieldGrid& grid) {
    const ShadedScene::Triangle& triangle = scene.triangles[index];
    if (triangle.texture != ShadedScene::no_texture) return samples;
    if (scene.is_lit(index)) {
        if (!scene.radiance_cache) return samples;
        const shading::LightGrid& points = scene.radiance_cache->grid(index);
        return points.points && points.is_radiance ? cached : samples;
    }
    return shift(scene, index, grid.focal_plane()->depth) <= max_shift * width_of_samples(scene, index, grid) ? vertices
                                                                                                              : samples;
}

// Shades each point of the projected scene as the scene's point with this projection.
class UnprojectedLighting final : public SampleLighting {
  public:
    UnprojectedLighting(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), focal_(grid.focal_plane()->depth) {}

    // Samples store one unused number, because each is shaded separately in radiance().
    Size size_of_light(std::size_t mesh) const override {
        return mesh == vertices ? Size{0, 0} : mesh == cached ? Size{3, 0} : Size{0, 1};
    }
    bool light_is_radiance(std::size_t mesh) const override { return mesh == cached; }
    void light_on(const ShadedScene& projected, std::size_t index, const std::array<float, 3>& weights,
                  std::span<float> light) const override {
        if (projected.triangles[index].mesh == cached)
            scene_->lighting->light_on(*scene_, index, unprojected_weights(index, weights), light);
        else
            light[0] = 0;
    }

    Rgb radiance(const ShadedScene& projected, std::size_t index, const std::array<float, 3>& weights,
                 std::span<const float> light, Rgb texture, const ViewSample& view) const override {
        if (projected.triangles[index].mesh == cached) return texture * Rgb{light[0], light[1], light[2]};
        Vec3 projection{};
        for (std::size_t i = 0; i < 3; ++i)
            projection = projection +
                         static_cast<double>(weights[i]) * projected.positions[scene_->triangles[index].vertices[i]];
        const auto [b0, b1, b2] = unprojected_weights(index, weights);
        return radiance_at(*scene_, index, b0, b1, b2, view_of(projection, view.to_viewer));
    }

  private:
    // Converts weights: P/w = Σ b′_i P_i/w_i, so that P = Σ b_i P_i with b_i = w b′_i/w_i, normalised to Σ b_i = 1.
    std::array<float, 3> unprojected_weights(std::size_t index, const std::array<float, 3>& projected) const {
        std::array<double, 3> b;
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            b[i] = projected[i] / w_at(-scene_->positions[scene_->triangles[index].vertices[i]].z, focal_);
            sum += b[i];
        }
        return {static_cast<float>(b[0] / sum), static_cast<float>(b[1] / sum), static_cast<float>(b[2] / sum)};
    }

    // Returns the sample that sees the point through the focal plane, and its projection from this direction.
    ViewSample view_of(Vec3 projection, Vec3 to_viewer) const {
        const double u = -to_viewer.x / to_viewer.z, v = -to_viewer.y / to_viewer.z, depth = -projection.z;
        const double s = projection.x - u * depth, t = projection.y - v * depth;
        return view_sample(grid_, u - s / focal_, v - t / focal_, depth_of_projection(depth, focal_));
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    double focal_;
};

// Returns the spacing that keeps the number of cached points of each triangle; 0 for uncached triangles.
std::vector<float> spacing_of_points(const ShadedScene& scene, const ShadedScene& projected) {
    std::vector<float> spacing(projected.triangles.size());
    for (std::size_t i = 0; i < spacing.size(); ++i) {
        if (projected.triangles[i].mesh != cached) continue;
        const auto [a, b, c] = projected.triangles[i].vertices;
        const auto& positions = projected.positions;
        const double longest = std::max({length(positions[b] - positions[a]), length(positions[c] - positions[b]),
                                         length(positions[a] - positions[c])});
        const double cells = scene.radiance_cache->grid(i).rows;
        constexpr double rounding = 1e-5;  // so that no row is added
        spacing[i] = static_cast<float>((1 + rounding) * longest /
                                        (cells > 0 ? cells + 2 * double{shading::LightGrid::inset} : 1));
    }
    return spacing;
}

class UnprojectedRenderer final : public Renderer {
  public:
    UnprojectedRenderer(std::unique_ptr<Renderer> projected, const LightFieldGrid& grid, std::string needs)
        : projected_(std::move(projected)), grid_(grid), needs_(std::move(needs)) {}

    const LightFieldGrid& grid() const override { return grid_; }
    bool has_depth() const override { return projected_->has_depth(); }
    HogelRange preferred_tile() const override { return projected_->preferred_tile(); }

    void read(LightFieldTile& tile) const override {
        projected_->read(tile);
        const double focal = grid_.focal_plane()->depth;
        for (float& depth : tile.depth.elements())
            if (std::isfinite(depth)) depth = static_cast<float>(depth_of_projection(depth, focal));
    }

    void set_scene(std::shared_ptr<const ShadedScene> scene) override {
        projected_->set_scene(projected_scene(scene, grid_, needs_));
    }

  private:
    std::unique_ptr<Renderer> projected_;
    LightFieldGrid grid_;
    std::string needs_;
};

}  // namespace

std::shared_ptr<const ShadedScene> projected_scene(const std::shared_ptr<const ShadedScene>& scene,
                                                   const LightFieldGrid& grid, const std::string& renderer) {
    const double focal = grid.focal_plane()->depth;
    auto projected = std::make_shared<ShadedScene>();
    projected->background = scene->background;
    projected->fronts_only = scene->fronts_only;
    projected->provenance = scene->provenance;
    projected->radiance = scene->radiance;
    projected->texture_coordinates = scene->texture_coordinates;
    projected->triangles = scene->triangles;
    bool needs_lighting = false, needs_cache = false;
    for (std::size_t i = 0; i < projected->triangles.size(); ++i) {
        ShadedScene::Triangle& triangle = projected->triangles[i];
        triangle.texture = ShadedScene::no_texture;
        triangle.mesh = light_at(*scene, i, grid);
        needs_lighting = needs_lighting || triangle.mesh != vertices;
        needs_cache = needs_cache || triangle.mesh == cached;
        for (const std::uint32_t vertex : triangle.vertices)
            if (!(w_at(-scene->positions[vertex].z, focal) >= min_w))
                throw Error(ErrorCode::usage, "algorithm, focal_plane",
                            fmt::format("{} needs a scene that does not reach the fixed focal plane; this one has a "
                                        "point at a depth of {}, and the plane is at {}",
                                        renderer, format_length(-scene->positions[vertex].z), format_length(focal)));
    }
    // Points outside all triangles may have any position, because no ray sees them.
    for (const Vec3& p : scene->positions) {
        const double w = w_at(-p.z, focal);
        projected->positions.push_back(w >= min_w ? p * (1 / w) : Vec3{});
    }
    if (needs_lighting) projected->lighting = std::make_shared<UnprojectedLighting>(scene, grid);
    if (needs_cache) shading::add_radiance_cache(*projected, spacing_of_points(*scene, *projected));
    return projected;
}

LightFieldGrid projected_grid(const LightFieldGrid& grid) {
    LightFieldGrid projected = grid;
    projected.view = Perspective{grid.range()};
    return projected;
}

std::unique_ptr<Renderer> unprojected(std::unique_ptr<Renderer> projected, const LightFieldGrid& grid,
                                      std::string needs) {
    return std::make_unique<UnprojectedRenderer>(std::move(projected), grid, std::move(needs));
}

}  // namespace hogel::render
