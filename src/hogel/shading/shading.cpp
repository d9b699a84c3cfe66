// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/shading/doubled_faces.h"
#include "hogel/shading/layers.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/maps.h"
#include "hogel/shading/sides.h"

namespace hogel {

using namespace shading;

namespace {

constexpr std::size_t max_texels = 32768;  // along a side of a shadow map
constexpr const char* automatic = "auto";

/// Returns whether more than a tenth of a scene's surface has maps of gloss or relief, which only `direct` renders.
bool has_maps_of_gloss(const Scene& scene) {
    const auto has_maps = [](const Mesh& mesh) {
        return mesh.radiance.empty() && (mesh.material.metallic_roughness_texture || mesh.material.normal_texture);
    };
    if (std::ranges::none_of(scene.meshes, has_maps)) return false;
    double total_area = 0, mapped_area = 0;
    for (const Mesh& mesh : scene.meshes) {
        double area = 0;
        for (const auto& [a, b, c] : mesh.triangles)
            area += length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
        total_area += area;
        if (has_maps(mesh)) mapped_area += area;
    }
    return mapped_area > 0.1 * total_area;
}

/// Alias for another model, selected by shading_model().
ShadingInfo automatic_shading() {
    return {
        .name = automatic,
        .text = "direct for a file with large triangles or maps of gloss, vertex for others",
        .make = [](const Scene& scene, const ShadingOptions& options, ShadedScene& shaded, const Progress& progress) {
            return shading_models().find(shading_model(scene, options)).make(scene, options, shaded, progress);
        }};
}

void require_normals(const Scene& scene) {
    if (scene.lights.empty()) return;
    for (const Mesh& mesh : scene.meshes)
        if (mesh.normals.empty() && !mesh.triangles.empty() && mesh.radiance.empty())
            throw Error(ErrorCode::bad_input,
                        "mesh '" + mesh.name + "': no normals; expected one a vertex (see add_missing_normals)");
}

void require_memory(const Scene& scene, const ShadingOptions& options, double bytes) {
    if (options.shadow_map < 1 || options.shadow_map > max_texels)
        throw Error(ErrorCode::usage, "shadow_map",
                    fmt::format("shadow maps of {} texels a side; expected 1 to {}", options.shadow_map, max_texels));
    if (bytes > options.max_shadow_bytes)
        throw Error(
            ErrorCode::usage, "shadow_map",
            fmt::format("shadow maps of {} texels a side for {} lights take {:.3g} GB; expected at most {:.3g} GB",
                        options.shadow_map, scene.lights.size(), bytes / 1e9, options.max_shadow_bytes / 1e9));
}

/// Textures of a scene that is being shaded, each picture once. Textures of the last shading are reused.
class Textures {
  public:
    Textures(std::vector<Texture>& textures, bool filtered)
        : textures_(textures), last_(std::move(textures)), filtered_(filtered) {
        textures_.clear();
    }

    std::uint32_t index(const std::shared_ptr<const Image>& picture, const TextureSampling& sampling) {
        if (!picture || picture->pixels.size() == 0) return ShadedScene::no_texture;
        for (const auto& [texture, number] : indices_[picture.get()])
            if (texture == sampling) return number;
        const auto number = static_cast<std::uint32_t>(textures_.size());
        indices_[picture.get()].emplace_back(sampling, number);
        add(picture, sampling);
        return number;
    }

  private:
    void add(const std::shared_ptr<const Image>& picture, const TextureSampling& sampling) {
        for (Texture& last : last_)
            if (last.picture() == picture && last.filtered() == filtered_ && last.sampling() == sampling) {
                textures_.push_back(std::move(last));
                return;
            }
        textures_.emplace_back(picture, filtered_, sampling);
    }

    std::vector<Texture>& textures_;
    std::vector<Texture> last_;
    bool filtered_;
    std::map<const Image*, std::vector<std::pair<TextureSampling, std::uint32_t>>> indices_;
};

void set_geometry(const Scene& scene, bool filter_textures, ShadedScene& shaded) {
    shaded.background = scene.background;
    shaded.positions.clear();
    shaded.radiance.clear();
    shaded.texture_coordinates.clear();
    shaded.triangles.clear();
    Textures textures(shaded.textures, filter_textures);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const auto base = static_cast<std::uint32_t>(shaded.positions.size());
        shaded.positions.insert(shaded.positions.end(), mesh.positions.begin(), mesh.positions.end());
        shaded.texture_coordinates.insert(shaded.texture_coordinates.end(), mesh.texture_coordinates.begin(),
                                          mesh.texture_coordinates.end());
        shaded.texture_coordinates.resize(shaded.positions.size());
        shaded.radiance.insert(shaded.radiance.end(), mesh.radiance.begin(), mesh.radiance.end());
        shaded.radiance.resize(shaded.positions.size());
        const std::uint32_t texture =
            textures.index(mesh.material.base_color_texture, mesh.material.base_color_sampling);
        for (const auto& [a, b, c] : mesh.triangles)
            shaded.triangles.push_back({{base + a, base + b, base + c}, texture, static_cast<std::uint32_t>(m)});
    }
}

}  // namespace

Table<ShadingInfo>& shading_models() {
    static Table<ShadingInfo> table(
        "shading model", {automatic_shading(), vertex_shading(), direct_shading(), shadowed_shading(), given_shading()},
        "shading");
    return table;
}

std::string shading_model(const Scene& scene, const ShadingOptions& options) {
    if (options.model != automatic) return shading_models().find(options.model).name;
    ShadingOptions direct = options;
    direct.model = "direct";
    const bool is_direct = (scene.has_large_triangles || has_maps_of_gloss(scene)) &&
                           shadow_map_bytes(scene, direct) <= options.max_shadow_bytes;
    return is_direct ? direct.model : "vertex";
}

double shadow_map_bytes(const Scene& scene, const ShadingOptions& options) {
    const ShadingInfo& model = shading_models().find(shading_model(scene, options));
    return model.shadow_map_bytes ? model.shadow_map_bytes(scene, options) : 0;
}

void shade_scene_into(const Scene& scene, const ShadingOptions& options, ShadedScene& shaded,
                      const Progress& progress) {
    const core::StopScope scope(progress);
    const ShadingInfo& model = shading_models().find(shading_model(scene, options));
    validate(scene);
    require_normals(scene);
    if (model.shadow_map_bytes) require_memory(scene, options, model.shadow_map_bytes(scene, options));
    shaded.radiance_cache = nullptr;
    shaded.layers = nullptr;
    set_geometry(scene, options.filter_textures, shaded);
    set_alphas(scene, shaded);
    keep_one_of_doubled_faces(shaded);
    const std::optional<Scene> turned = shaded.fronts_only ? std::nullopt : with_seen_sides(scene, shaded);
    if (turned) {
        set_geometry(*turned, options.filter_textures, shaded);
        set_alphas(*turned, shaded);
    }
    const Scene& shown = turned ? *turned : scene;
    shaded.lighting = with_maps(shown, options, model.make(shown, options, shaded, progress));
    separate_layers(shaded);
    shaded.provenance = {{"scene", scene.name}};
    if (!std::ranges::all_of(scene.meshes, [](const Mesh& mesh) { return !mesh.radiance.empty(); }))
        shaded.provenance.emplace_back("shading", model.name);
    if (scene.background != Rgb{0, 0, 0}) shaded.provenance.push_back(background_entry(scene.background));
    shaded.provenance = with_history(std::move(shaded.provenance), scene.provenance);
}

ShadedScene shade_scene(const Scene& scene, const ShadingOptions& options, const Progress& progress) {
    ShadedScene shaded;
    shade_scene_into(scene, options, shaded, progress);
    return shaded;
}

ShadedScene shade_scene_vertices(const Scene& scene) {
    return shade_scene(scene, {.model = "vertex", .filter_textures = false});
}

}  // namespace hogel
