// SPDX-License-Identifier: Apache-2.0
// Defines a renderer and adds it to the table of renderers, so that the pipeline finds it by name.
#include <cstdio>
#include <memory>

#include "hogel/hogel.h"

using namespace hogel;
using namespace hogel::literals;

// Renders the depth of the first triangle on each ray as brightness. For simplicity it tests every triangle.
class DepthRenderer final : public LightFieldSource {
  public:
    DepthRenderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid)
        : scene_(std::move(scene)), grid_(grid) {}
    const LightFieldGrid& grid() const override { return grid_; }
    void read(LightFieldTile& tile) const override {
        const HogelRange& range = tile.range;
        for (std::size_t t = 0; t < range.nt; ++t)
            for (std::size_t s = 0; s < range.ns; ++s)
                for (std::size_t v = 0; v < grid_.directions_v; ++v)
                    for (std::size_t u = 0; u < grid_.directions_u; ++u) {
                        const double depth = first_depth(grid_.s(double(range.s0 + s)), grid_.t(double(range.t0 + t)),
                                                         grid_.u(double(u)), grid_.v(double(v)));
                        for (std::size_t c = 0; c < grid_.channels; ++c)
                            tile.radiance(c, t, s, v, u) = depth < 1 ? float(1 - 50 * depth) : 0.0f;
                    }
    }

  private:
    // Returns the smallest ζ at which the ray x = s + Uζ, y = t + Vζ meets a triangle; infinity if it meets none.
    double first_depth(double s, double t, double U, double V) const {
        double first = std::numeric_limits<double>::infinity();
        for (const ShadedScene::Triangle& triangle : scene_->triangles) {
            const Vec3 a = scene_->positions[triangle.vertices[0]], b = scene_->positions[triangle.vertices[1]],
                       c = scene_->positions[triangle.vertices[2]];
            const Vec3 direction{U, V, -1}, ab = b - a, ac = c - a, p = cross(direction, ac);
            const double determinant = dot(ab, p);
            if (determinant == 0) continue;
            const Vec3 from_a = Vec3{s, t, 0} - a, q = cross(from_a, ab);
            const double weight_b = dot(from_a, p) / determinant, weight_c = dot(direction, q) / determinant;
            const double depth = dot(ac, q) / determinant;
            if (weight_b >= 0 && weight_c >= 0 && weight_b + weight_c <= 1 && depth < first) first = depth;
        }
        return first;
    }

    std::shared_ptr<const ShadedScene> scene_;
    LightFieldGrid grid_;
};

int main() {
    RendererInfo info;
    info.name = "depth";
    info.text = "depth of the first triangle on each ray";
    info.make = [](std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid) {
        return std::make_unique<DepthRenderer>(std::move(scene), grid);
    };
    renderers().add(info);

    LightFieldRequest request;
    request.renderer = "depth";
    request.grid = {24, 24, 200_um, 8, 8, field_of_view(14_deg)};
    const LightField light_field = render_light_field(load_scene("two-planes", request), request);
    const Camera camera = camera_for(light_field.grid().width(), light_field.grid().height(), 96);
    write_image("depth.png", photograph(light_field, camera));
    std::printf("depth.png by the renderer '%s'\n", request.renderer.c_str());
}
