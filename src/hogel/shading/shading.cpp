// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/triangles.h"
#include "hogel/trace/ray_caster.h"

namespace hogel {

using namespace shading;

namespace {

constexpr std::array models{
    ShadingInfo{ShadingModel::vertex, "vertex", "lit at the vertices, with shadows, and interpolated; matt"},
    ShadingInfo{ShadingModel::direct, "direct", "lit at every sample, with shadow maps and gloss"},
    ShadingInfo{ShadingModel::shadowed, "shadowed", "lit at the vertices, shadow maps at every sample; matt"},
    ShadingInfo{ShadingModel::given, "given", "the radiance that the mesh brings (see hogel bake)"},
};

constexpr std::size_t vertices_per_task = 1024;
constexpr std::size_t max_texels = 32768;  // along a side of a shadow map

bool has_shadows(const Scene& scene) {
    return std::ranges::any_of(scene.lights, [](const Light& light) { return light.casts_shadows; });
}

ShadedScene geometry(const Scene& scene, bool filter_textures) {
    validate(scene);
    ShadedScene shaded;
    shaded.background = scene.background;
    std::map<const Image*, std::uint32_t> texture_index;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (mesh.normals.empty() && !scene.lights.empty() && !mesh.triangles.empty() && mesh.radiance.empty())
            throw Error(ErrorCode::bad_input,
                        "mesh '" + mesh.name + "': no normals; expected one a vertex (see add_missing_normals)");
        const auto base = static_cast<std::uint32_t>(shaded.positions.size());
        shaded.positions.insert(shaded.positions.end(), mesh.positions.begin(), mesh.positions.end());
        if (mesh.texture_coordinates.empty())
            shaded.texture_coordinates.resize(shaded.positions.size());
        else
            shaded.texture_coordinates.insert(shaded.texture_coordinates.end(), mesh.texture_coordinates.begin(),
                                              mesh.texture_coordinates.end());
        shaded.radiance.insert(shaded.radiance.end(), mesh.radiance.begin(), mesh.radiance.end());
        shaded.radiance.resize(shaded.positions.size());
        std::uint32_t texture = ShadedScene::no_texture;
        if (const auto& image = mesh.material.base_color_texture; image && image->pixels.size() > 0) {
            const auto [known, is_new] =
                texture_index.emplace(image.get(), static_cast<std::uint32_t>(shaded.textures.size()));
            if (is_new) shaded.textures.emplace_back(image, filter_textures);
            texture = known->second;
        }
        for (const auto& [a, b, c] : mesh.triangles)
            shaded.triangles.push_back({{base + a, base + b, base + c}, texture, static_cast<std::uint32_t>(m)});
    }
    return shaded;
}

void light_vertices(const Scene& scene, ShadedScene& shaded) {
    const trace::RayCaster caster = has_shadows(scene) ? all_triangles(shaded) : trace::RayCaster(shaded.positions, {});
    const double offset = ray_offset(scene);
    constexpr auto reflected = static_cast<float>(std::numbers::inv_pi);
    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.positions.size();
        const std::size_t tasks = mesh.radiance.empty() ? (n + vertices_per_task - 1) / vertices_per_task : 0;
        core::parallel_for(tasks, [&](std::size_t task) {
            const std::size_t first = task * vertices_per_task;
            for (std::size_t i = first; i < std::min(n, first + vertices_per_task); ++i) {
                core::throw_if_stopped();
                Rgb light = scene.ambient;
                if (!mesh.normals.empty())
                    light += reflected * irradiance(scene, caster, offset, mesh.positions[i], mesh.normals[i]);
                shaded.radiance[base + i] = vertex_color(mesh, i) * light + mesh.material.emission;
            }
        });
        base += n;
    }
}

void require_given(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (mesh.radiance.empty() && !mesh.triangles.empty())
            throw Error(ErrorCode::bad_input,
                        fmt::format("mesh '{}': brings no radiance; expected one a vertex for shading 'given' (see "
                                    "hogel bake)",
                                    mesh.name));
}

void require_room(const Scene& scene, const ShadingOptions& options) {
    if (options.shadow_map < 1 || options.shadow_map > max_texels)
        throw Error(ErrorCode::usage,
                    fmt::format("shadow maps of {} texels a side; expected 1 to {}", options.shadow_map, max_texels));
    const double bytes = shadow_map_bytes(scene, options);
    if (bytes > options.max_shadow_bytes)
        throw Error(
            ErrorCode::usage,
            fmt::format("shadow maps of {} texels a side for {} lights take {:.3g} GB; expected at most {:.3g} GB",
                        options.shadow_map, scene.lights.size(), bytes / 1e9, options.max_shadow_bytes / 1e9));
}

}  // namespace

std::span<const ShadingInfo> shading_models() { return models; }

ShadingModel shading_model(std::string_view name) {
    std::string known;
    for (const ShadingInfo& info : models) {
        if (info.name == name) return info.model;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", info.name);
    }
    throw Error(ErrorCode::usage, fmt::format("unknown shading '{}'; known: {}", name, known));
}

double shadow_map_bytes(const Scene& scene, const ShadingOptions& options) {
    if (options.model != ShadingModel::direct && options.model != ShadingModel::shadowed) return 0;
    double sum = 0;
    for (const Light& light : scene.lights) sum += ShadowMap::bytes(light, options.shadow_map);
    return sum;
}

ShadedScene shade_scene(const Scene& scene, const ShadingOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    ShadedScene shaded = geometry(scene, options.filter_textures);
    if (options.model == ShadingModel::given) require_given(scene);
    if (options.model == ShadingModel::vertex) light_vertices(scene, shaded);
    if (options.model != ShadingModel::direct && options.model != ShadingModel::shadowed) return shaded;
    require_room(scene, options);
    std::vector<ShadowMap> maps = make_shadow_maps(scene, all_triangles(shaded), options.shadow_map, progress);
    shaded.lighting = options.model == ShadingModel::direct ? make_direct_lighting(scene, std::move(maps))
                                                            : make_shadowed_lighting(scene, std::move(maps));
    return shaded;
}

ShadedScene shade_scene_vertices(const Scene& scene) {
    return shade_scene(scene, {.model = ShadingModel::vertex, .filter_textures = false});
}

}  // namespace hogel
