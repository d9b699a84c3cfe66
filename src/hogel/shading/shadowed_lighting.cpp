// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <numbers>

#include "hogel/shading/illumination.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/shadow_maps.h"
#include "hogel/shading/triangles.h"
#include "hogel/work/parallel.h"

namespace hogel::shading {
namespace {

constexpr std::size_t shadowed_vertices_per_task = 4096;

/// Lighting that interpolates the unshadowed light of each lamp between the vertices, and multiplies it by the
/// visibility from the lamp's shadow map at each sample.
class ShadowedLighting final : public SampleLighting {
  public:
    void set_scene(const Scene& scene, const trace::RayCaster& caster, std::size_t texels, const Progress& progress) {
        maps_.set(make_shadow_maps(scene, caster, texels, maps_.release(), progress));
        intensities_.clear();
        for (const Light& light : scene.lights) intensities_.push_back(light.intensity);
        given_.clear();
        above_.clear();
        colors_.clear();
        unshadowed_.clear();
        std::size_t base = 0;
        for (const Mesh& mesh : scene.meshes) {
            add_mesh(scene, mesh, base);
            base += mesh.positions.size();
        }
    }

    // Light is the radiance before the texture.
    Size size_of_light(std::size_t mesh) const override { return given_[mesh] ? Size{} : Size{3, 0}; }
    bool light_is_radiance(std::size_t) const override { return true; }

    void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                  std::span<float> radiance) const override {
        const ShadedScene::Triangle& triangle = scene.triangles[index];
        const auto& vertices = triangle.vertices;
        const SurfacePoint point(scene, vertices, weights);
        const double size = length(point.flat_normal);
        const Vec3 above =
            size > 0 ? point.position + above_[triangle.mesh] / size * point.flat_normal : point.position;
        Rgb sum = interpolate(unshadowed_, vertices, weights);
        constexpr auto reflected = static_cast<float>(std::numbers::inv_pi);
        constexpr std::size_t block = 64;
        for (std::size_t first = 0; first < intensities_.size(); first += block) {
            std::array<std::uint32_t, block> shining;  // lamps that contribute; reflected light is in `lights`
            std::array<Rgb, block> lights;
            std::size_t count = 0;
            for (std::size_t k = first; k < std::min(first + block, intensities_.size()); ++k) {
                Rgb light{0, 0, 0};
                for (std::size_t i = 0; i < 3; ++i)
                    light += weights[i] * irradiance_[vertices[i] * intensities_.size() + k] * colors_[vertices[i]];
                lights[count] = light;
                shining[count] = static_cast<std::uint32_t>(k);
                if (light != Rgb{0, 0, 0}) ++count;
            }
            std::array<float, block> visible;
            maps_.visibility(std::span(shining).first(count), above, point.flat_normal, visible.data());
            for (std::size_t i = 0; i < count; ++i)
                sum += reflected * visible[i] * (intensities_[shining[i]] * lights[i]);
        }
        radiance[0] = sum.r;
        radiance[1] = sum.g;
        radiance[2] = sum.b;
    }

  private:
    // Adds the vertices of a mesh, numbered from `base`.
    void add_mesh(const Scene& scene, const Mesh& mesh, std::size_t base) {
        const std::size_t n = mesh.positions.size(), lights = scene.lights.size();
        given_.push_back(!mesh.radiance.empty());
        above_.push_back(ray_offset(mesh, 0));
        for (std::size_t i = 0; i < n; ++i) {
            const Rgb color = vertex_color(mesh, i);
            colors_.push_back(color);
            unshadowed_.push_back(color * scene.ambient + vertex_emission(mesh.material));
        }
        irradiance_.resize((base + n) * lights);
        work::parallel_for((n + shadowed_vertices_per_task - 1) / shadowed_vertices_per_task, [&](std::size_t task) {
            for (std::size_t i = task * shadowed_vertices_per_task;
                 i < std::min(n, (task + 1) * shadowed_vertices_per_task); ++i)
                for (std::size_t k = 0; k < lights; ++k) {
                    const Illumination illumination = illuminate(scene.lights[k], mesh.positions[i]);
                    const double cosine = mesh.normals.empty() ? 0 : dot(mesh.normals[i], illumination.to_light);
                    irradiance_[(base + i) * lights + k] =
                        static_cast<float>(std::max(0.0, cosine) * illumination.falloff);
                }
        });
    }

    ShadowMaps maps_;
    std::vector<Rgb> intensities_;
    std::vector<bool> given_;    // whether the radiance of a mesh is given
    std::vector<double> above_;  // height above each mesh for shadow map lookups, metres
    std::vector<Rgb> colors_, unshadowed_;
    std::vector<float> irradiance_;  // [vertex][light], per intensity
};

}  // namespace

ShadingInfo shadowed_shading() {
    return {.name = "shadowed",
            .text = "lit at the vertices, shadow maps at every sample; matt",
            .make =
                [](const Scene& scene, const ShadingOptions& options, ShadedScene& shaded, const Progress& progress) {
                    auto lighting = take_lighting<ShadowedLighting>(shaded);
                    lighting->set_scene(scene, shadow_caster(scene, shaded, "shadowed"), options.shadow_map, progress);
                    return lighting;
                },
            .shadow_map_bytes = bytes_of_shadow_maps};
}

}  // namespace hogel::shading
