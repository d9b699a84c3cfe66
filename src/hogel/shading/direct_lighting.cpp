// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>

#include "hogel/shading/gloss.h"
#include "hogel/shading/illumination.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/maps.h"
#include "hogel/shading/reflection.h"
#include "hogel/shading/shadow_maps.h"
#include "hogel/shading/triangles.h"

namespace hogel::shading {
namespace {

/// Lighting that evaluates every light at each sample, through its shadow map, with the material at that point.
class DirectLighting final : public SampleLighting {
  public:
    void set_scene(const Scene& scene, const trace::RayCaster& caster, const ShadingOptions& options,
                   const Progress& progress) {
        lights_ = scene.lights;
        lamps_ = LampTable(lights_);
        maps_.set(make_shadow_maps(scene, caster, options.shadow_map, maps_.release(), progress));
        lobes_ = metallic_roughness_textures(scene, options.filter_textures);
        reliefs_ = normal_textures(scene, options.filter_textures);
        occlusions_ = occlusion_textures(scene, options.filter_textures);
        ambient_ = scene.ambient;
        surfaces_.clear();
        normals_.clear();
        colors_.clear();
        for (const Mesh& mesh : scene.meshes) {
            surfaces_.push_back({without_textures(mesh.material), !mesh.radiance.empty(), ray_offset(mesh, 0)});
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                normals_.push_back(mesh.normals.empty() ? Vec3{0, 0, 0} : mesh.normals[i]);
                colors_.push_back(vertex_color(mesh, i));
            }
        }
    }

    // Light is the radiance on matt surfaces. On glossy surfaces it is the irradiance, the part of it that depends on
    // the lobe, and the visibility of each lamp.
    Size size_of_light(std::size_t mesh) const override {
        const Surface& surface = surfaces_[mesh];
        if (surface.given) return {};
        return surface.material.is_glossy() ? Size{6, lamps_.size()} : Size{3, 0};
    }

    bool light_is_radiance(std::size_t mesh) const override { return !surfaces_[mesh].material.is_glossy(); }

    void light_on(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                  std::span<float> light) const override {
        const ShadedScene::Triangle& triangle = scene.triangles[index];
        const Surface& surface = surfaces_[triangle.mesh];
        std::ranges::fill(light, 0.0f);
        const bool glossy = surface.material.is_glossy();
        const SurfacePoint point(scene, triangle.vertices, weights);
        const Vec3 normal = normal_at(scene, triangle, weights, 0);
        std::optional<Material> textured;
        const Material& material = material_at(scene, triangle, weights, 0, textured);
        LightUnderLobe sum;
        constexpr std::size_t block = 64;
        for (std::size_t first = 0; first < lights_.size(); first += block) {
            std::array<std::uint32_t, block> facing;  // lamps in front of the surface
            std::array<double, block> cosines, falloffs, in_cones;
            std::size_t count = 0;
            for (std::size_t i = first; i < std::min(first + block, lights_.size()); ++i) {
                const Illumination illumination = illuminate(lights_[i], point.position);
                cosines[count] = dot(normal, illumination.to_light);
                falloffs[count] = illumination.falloff;
                in_cones[count] = illumination.in_cone;
                facing[count] = static_cast<std::uint32_t>(i);
                if (cosines[count] > 0 && illumination.falloff > 0) ++count;
            }
            std::array<float, block> visible;
            maps_.visibility(std::span(facing).first(count), point.position + surface.above * normal, point.flat_normal,
                             visible.data());
            for (std::size_t k = 0; k < count; ++k) {
                if (!(visible[k] > 0)) continue;
                sum.add(material, visible[k] * static_cast<float>(falloffs[k]) * lights_[facing[k]].intensity,
                        cosines[k]);
                if (glossy) light[6 + facing[k]] = visible[k] * static_cast<float>(in_cones[k]);
            }
        }
        if (glossy) {
            put(sum.arriving, light.first<3>());
            put(sum.for_lobe, light.subspan<3, 3>());
        } else {
            const Rgb color = interpolate(colors_, triangle.vertices, weights);
            put(surface.material.emission + color * (ambient_at(scene, triangle, weights, 0) + sum.arriving),
                light.first<3>());
        }
    }

    Rgb radiance(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                 std::span<const float> light, Rgb texture, const ViewSample& view) const override {
        const ShadedScene::Triangle& triangle = scene.triangles[index];
        const Surface& surface = surfaces_[triangle.mesh];
        if (!surface.material.is_glossy()) return texture * rgb(light.first<3>());
        const Rgb color = texture * interpolate(colors_, triangle.vertices, weights);
        const Rgb emission = texture * surface.material.emission, arriving = rgb(light.first<3>());
        const Vec3 normal = normal_at(scene, triangle, weights, view.footprint);
        std::optional<Material> textured;
        const Material& material = material_at(scene, triangle, weights, view.footprint, textured);
        const Reflection reflection(material, color, dot(normal, view.to_viewer));
        Rgb result = emission + ambient_at(scene, triangle, weights, view.footprint) * reflection.in_uniform_light() +
                     reflection.diffuse({arriving, rgb(light.subspan<3, 3>())});
        if (const double cos_view = dot(normal, view.to_viewer); cos_view > 0)
            result += reflection.lobe(gloss(lamps_, light.subspan(6).data(),
                                            {SurfacePoint(scene, triangle.vertices, weights).position, normal,
                                             view.to_viewer, cos_view, reflection.roughness()}));
        return result;
    }

  private:
    struct Surface {
        Material material;
        bool given;
        double above = 0;  ///< height above the surface for shadow map lookups, metres
    };

    static Material without_textures(Material material) {
        material.emission = vertex_emission(material);
        material.base_color_texture = material.emission_texture = material.metallic_roughness_texture =
            material.normal_texture = material.occlusion_texture = nullptr;
        return material;
    }
    // Returns the material of a mesh; with a texture of its lobe, the material at this point, stored in `textured`.
    const Material& material_at(const ShadedScene& scene, const ShadedScene::Triangle& triangle,
                                const std::array<float, 3>& weights, double footprint,
                                std::optional<Material>& textured) const {
        const Material& material = surfaces_[triangle.mesh].material;
        if (!lobes_.has(triangle.mesh)) return material;
        const Rgb factors = lobes_[triangle.mesh].sample(scene, triangle.vertices, weights, footprint);
        textured = material;
        textured->roughness *= factors.g;
        textured->metallic *= factors.b;
        return *textured;
    }

    static Rgb rgb(std::span<const float, 3> values) { return {values[0], values[1], values[2]}; }
    static void put(Rgb value, std::span<float, 3> values) {
        values[0] = value.r;
        values[1] = value.g;
        values[2] = value.b;
    }

    Rgb ambient_at(const ShadedScene& scene, const ShadedScene::Triangle& triangle, const std::array<float, 3>& weights,
                   double footprint) const {
        if (!occlusions_.has(triangle.mesh)) return ambient_;
        const float occlusion = occlusions_[triangle.mesh].sample(scene, triangle.vertices, weights, footprint).r;
        return (1 + surfaces_[triangle.mesh].material.occlusion_strength * (occlusion - 1)) * ambient_;
    }

    Vec3 normal_at(const ShadedScene& scene, const ShadedScene::Triangle& triangle, const std::array<float, 3>& weights,
                   double footprint) const {
        const auto& [a, b, c] = triangle.vertices;
        const Vec3 sum =
            double{weights[0]} * normals_[a] + double{weights[1]} * normals_[b] + double{weights[2]} * normals_[c];
        const double size = length(sum);
        const Vec3 normal = size > 0 ? sum / size : sum;
        if (!reliefs_.has(triangle.mesh) || !(size > 0)) return normal;
        return mapped_normal(scene, reliefs_[triangle.mesh], triangle.vertices, weights, footprint, normal,
                             surfaces_[triangle.mesh].material.normal_scale);
    }

    std::vector<Light> lights_;
    LampTable lamps_;
    ShadowMaps maps_;
    MeshTextures lobes_, reliefs_, occlusions_;
    Rgb ambient_;
    std::vector<Surface> surfaces_;  // one per mesh
    std::vector<Vec3> normals_;
    std::vector<Rgb> colors_;
};

}  // namespace

ShadingInfo direct_shading() {
    return {.name = "direct",
            .text = "lit at every sample, with shadow maps and gloss",
            .make =
                [](const Scene& scene, const ShadingOptions& options, ShadedScene& shaded, const Progress& progress) {
                    auto lighting = take_lighting<DirectLighting>(shaded);
                    lighting->set_scene(scene, shadow_caster(scene, shaded, "direct"), options, progress);
                    return lighting;
                },
            .shadow_map_bytes = bytes_of_shadow_maps};
}

}  // namespace hogel::shading
