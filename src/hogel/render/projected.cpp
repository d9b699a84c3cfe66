// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/projected.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "hogel/render/sample_store.h"
#include "hogel/units.h"

namespace hogel::render {
namespace {

// Points nearer to the focal plane than this share of its depth would be projected too far away for floats.
constexpr double min_w = 1e-6;

// w of a point at depth ζ, and the depth ζ of a point whose projection is at depth ζ/w.
double w_at(double depth, double focal) { return 1 - depth / focal; }
double depth_of_projection(double projected, double focal) { return projected / (1 + projected / focal); }

// Shades points of the projected scene as those of the scene itself that they are the projections of.
class UnprojectedLighting final : public SampleLighting {
  public:
    UnprojectedLighting(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid), focal_(grid.focal_plane()->depth) {}

    // One number without meaning: every sample is shaded by itself, in radiance().
    Size size_of_light(std::size_t) const override { return {0, 1}; }
    bool light_is_radiance(std::size_t) const override { return false; }
    void light_on(const ShadedScene&, std::size_t, const std::array<float, 3>&, std::span<float> light) const override {
        light[0] = 0;
    }

    Rgb radiance(const ShadedScene& projected, std::size_t index, const std::array<float, 3>& weights,
                 std::span<const float>, Rgb, const ViewSample& view) const override {
        // P/w = Σ b′_i P_i/w_i, so that P = Σ b_i P_i with b_i = w b′_i/w_i; and Σ b_i = 1.
        const auto& vertices = scene_->triangles[index].vertices;
        Vec3 seen{};
        std::array<double, 3> b{};
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            seen = seen + static_cast<double>(weights[i]) * projected.positions[vertices[i]];
            b[i] = weights[i] / w_at(-scene_->positions[vertices[i]].z, focal_);
            sum += b[i];
        }
        return radiance_at(*scene_, index, static_cast<float>(b[0] / sum), static_cast<float>(b[1] / sum),
                           static_cast<float>(b[2] / sum), view_of(seen, view.to_viewer));
    }

  private:
    // The sample that sees the point through the focal plane; it sees its projection from that direction.
    ViewSample view_of(Vec3 projection, Vec3 to_viewer) const {
        const double u = -to_viewer.x / to_viewer.z, v = -to_viewer.y / to_viewer.z, depth = -projection.z;
        const double s = projection.x - u * depth, t = projection.y - v * depth;
        return view_sample(grid_, u - s / focal_, v - t / focal_, depth_of_projection(depth, focal_));
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
    double focal_;
};

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
    for (ShadedScene::Triangle& triangle : projected->triangles) {
        triangle.texture = ShadedScene::no_texture;
        for (const std::uint32_t vertex : triangle.vertices)
            if (!(w_at(-scene->positions[vertex].z, focal) >= min_w))
                throw Error(ErrorCode::usage,
                            fmt::format("{} needs a scene that does not reach the fixed focal plane; this one has a "
                                        "point at a depth of {}, and the plane is at {}",
                                        renderer, format_length(-scene->positions[vertex].z), format_length(focal)));
    }
    // Points of no triangle may be anywhere and are seen by nobody.
    for (const Vec3& p : scene->positions) {
        const double w = w_at(-p.z, focal);
        projected->positions.push_back(w >= min_w ? p * (1 / w) : Vec3{});
    }
    projected->lighting = std::make_shared<UnprojectedLighting>(scene, grid);
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
