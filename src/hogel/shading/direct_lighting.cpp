#include "hogel/shading/illumination.h"
#include "hogel/shading/lighting_internal.h"
#include "hogel/shading/reflection.h"

namespace hogel {
namespace {

/// Every light, through its shadow map, reflected by what the surface is made of at that very point.
class DirectLighting final : public SampleLighting {
  public:
    DirectLighting(const Scene& scene, std::vector<ShadowMap> maps)
        : lights_(scene.lights), maps_(std::move(maps)), ambient_(scene.ambient) {
        for (const Mesh& mesh : scene.meshes) {
            surfaces_.push_back({mesh.material, !mesh.radiance.empty()});
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                normals_.push_back(mesh.normals.empty() ? Vec3{0, 0, 0} : mesh.normals[i]);
                colors_.push_back(vertex_color(mesh, i));
            }
        }
    }

    Rgb radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights, Rgb texture,
                 const Sight& sight) const override {
        const ShadedScene::Triangle& triangle = scene.triangles[index];
        const Surface& surface = surfaces_[triangle.mesh];
        if (surface.given) return texture * interpolate(scene.radiance, triangle.vertices, weights);
        const SurfacePoint point(scene, triangle.vertices, weights);
        const auto& [a, b, c] = triangle.vertices;
        const Vec3 sum =
            double{weights[0]} * normals_[a] + double{weights[1]} * normals_[b] + double{weights[2]} * normals_[c];
        const double size = length(sum);
        const Vec3 normal = size > 0 ? sum / size : sum;
        const Rgb color = texture * interpolate(colors_, triangle.vertices, weights);
        const Reflection reflection(surface.material, color, dot(normal, sight.to_viewer));
        Rgb light = texture * surface.material.emission + ambient_ * reflection.in_uniform_light();
        for (std::size_t i = 0; i < lights_.size(); ++i) {
            const Illumination from = illuminate(lights_[i], point.position);
            const double cosine = dot(normal, from.to_light);
            if (!(cosine > 0)) continue;
            const float lit = maps_[i].lit(point.position, point.flat_normal);
            if (lit > 0)
                light += lit * static_cast<float>(from.falloff) *
                         (lights_[i].intensity * reflection.towards(normal, sight.to_viewer, from.to_light, cosine));
        }
        return light;
    }

  private:
    struct Surface {
        Material material;
        bool given;
    };

    std::vector<Light> lights_;
    std::vector<ShadowMap> maps_;
    Rgb ambient_;
    std::vector<Surface> surfaces_;  // of the meshes
    std::vector<Vec3> normals_;
    std::vector<Rgb> colors_;
};

}  // namespace

std::unique_ptr<SampleLighting> make_direct_lighting(const Scene& scene, std::vector<ShadowMap> maps) {
    return std::make_unique<DirectLighting>(scene, std::move(maps));
}

}  // namespace hogel
