// SPDX-License-Identifier: Apache-2.0
// Light fields of named scenes, rendered when they are read.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "hogel/core/part.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/pipeline/scene_placing.h"
#include "hogel/render/cache_spacing.h"
#include "hogel/scene/fit_scale.h"
#include "hogel/shading/radiance_cache.h"
#include "hogel/units.h"

namespace hogel {
namespace {

// Maximum size of light fields that are kept in memory instead of being rendered for each read, bytes.
constexpr double max_buffered_bytes = 2e9;
// Maximum size of cached tiles of larger light fields, bytes.
constexpr double max_cached_tile_bytes = 1e9;

// Throws if the request needs a part that this build does not have.
void require_built_in(const LightFieldRequest& request) {
    if (renderers().find(request.renderer).casts_rays)
        core::require_part("Embree", fmt::format("the renderer '{}'", request.renderer));
}

// Returns a light field rendered by simplex with interpolation between viewpoints.
LightField::Source interpolated(const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid,
                                const LightFieldRequest& request) {
    if (request.renderer != "simplex")
        throw Error(
            ErrorCode::usage, "interpolate",
            fmt::format("interpolation between viewpoints is for the renderer simplex, not {}", request.renderer));
    std::shared_ptr<const LightFieldSource> fine =
        make_interpolating_renderer(scene, finer(grid, request.samples), request.interpolate * request.samples.hogel);
    if (request.samples.count() == 1) return fine;
    return average(std::move(fine), grid, request.samples);
}

}  // namespace

std::vector<LightFieldGrid> LightFieldRequest::grids() const {
    validate(grid, ErrorCode::usage, "light field");
    return hemicube ? hogel::hemicube(grid, hemicube_across, hemicube_down) : std::vector{grid};
}

namespace pipeline {

void require_scene_file(const std::string& name) {
    if (std::filesystem::exists(name)) return;
    if (name.find_first_of("./") != std::string::npos)
        throw Error(ErrorCode::bad_input, fmt::format("{}: no such file", name));
    scenes().find(name);  // throws, naming the nearest scene
}

Scene place_built_in(Scene scene, const LightFieldRequest& request) {
    if (!request.pose.camera.empty()) find_camera(scene, request.pose.camera);
    turn_scene(scene, request.pose);
    place_scene(scene, request.pose, request.grid.width());
    return scene;
}

}  // namespace pipeline

InputKind input_kind(const std::string& name) {
    if (scenes().look_up(name) != nullptr) return InputKind::scene;
    pipeline::require_scene_file(name);
    if (is_view_set(name)) return InputKind::light_field;
    switch (file_kind(name)) {
        case FileKind::light_field:
            return InputKind::light_field;
        case FileKind::hologram:
            return InputKind::hologram;
        case FileKind::mesh:
            return InputKind::scene;
        case FileKind::picture:
            return is_external_field(name) ? InputKind::hologram : InputKind::scene;
        case FileKind::unknown:
            break;
    }
    for (const char* splats : {".splat", ".ksplat", ".spz"})
        if (std::filesystem::path(name).extension() == splats)
            throw Error(
                ErrorCode::bad_input,
                fmt::format("{}: holds Gaussian splats, which are no surfaces; expected a mesh or a point cloud",
                            name));
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: is neither a mesh, a picture, a light field nor a hologram", name));
}

LightField open_light_field_or_views(const std::filesystem::path& path, const Progress& progress) {
    return is_view_set(path) ? import_views(path, {}, progress).light_field : open_light_field(path);
}

namespace {

/// Returns whether large triangles cover more than half of the surface, in a scene with some detail. Shading at their
/// corners would miss or smear shadows.
bool has_large_triangles(const Scene& scene, double hologram_width) {
    constexpr std::size_t some_detail = 13;  // triangles: a box casts no shadow on itself
    if (triangle_count(scene) < some_detail) return false;
    double all = 0, large = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.radiance.empty() || mesh.name == points_name) continue;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vec3 ab = mesh.positions[b] - mesh.positions[a], bc = mesh.positions[c] - mesh.positions[b];
            const double area = length(cross(ab, bc)), side = std::max({length(ab), length(bc), length(ab + bc)});
            all += area;
            if (side > hologram_width / 8) large += area;
        }
    }
    return large > 0.5 * all;
}

/// Returns the fraction of a scene's depth in front of the hologram plane: as requested, but at most the smaller side
/// of the hologram. Parts further in front would be behind the eye or too close to it.
double limited_front_of(const Bounds& box, const Fit& fit) {
    const Vec3 size = box.high - box.low;
    return std::min(fit.front, std::min(fit.width, fit.height) / (scene::fit_scale(size, fit) * size.z));
}

void fit_with_limited_front(Scene& scene, Fit fit) {
    const Bounds box = bounds(scene);
    const double limited_front = limited_front_of(box, fit);
    if (limited_front < fit.front) {
        scene.notes.push_back(fmt::format(
            "it is deep: {:.2g} of its depth is in front of the hologram instead of {:.2g}", limited_front, fit.front));
        fit.front = limited_front;
    }
    fit_scene(scene, fit);
}

/// Adds a note about metal, gloss and relief if another shading model than `direct` is selected.
void note_gloss(Scene& scene, const ShadingOptions& options) {
    if (shading_model(scene, options) == "direct") return;
    const auto is_glossy = [](const Mesh& mesh) {
        const Material& material = mesh.material;
        return mesh.radiance.empty() && ((material.metallic > 0.5f && material.roughness < 0.95f) ||
                                         (material.is_glossy() && material.roughness < 0.5f) ||
                                         material.metallic_roughness_texture || material.normal_texture);
    };
    const auto count = std::ranges::count_if(scene.meshes, is_glossy);
    if (count > 0)
        scene.notes.push_back(
            fmt::format("{} of {} meshes have metal, gloss or relief, which only --shading direct shows", count,
                        scene.meshes.size()));
}

/// Returns the place of a depth for a note.
std::string place_of(double depth) {
    const char* const side = depth < 0 ? "in front of" : "behind";
    return fmt::format("{} {} the hologram", format_length(std::abs(depth)), side);
}

/// Fits the scene of a picture to the hologram, then turns it.
void place_picture(Scene& scene, const LightFieldRequest& request) {
    if (!request.fit) throw Error(ErrorCode::usage, "as_is", "a picture has no size of its own; leave out as-is");
    if (!request.pose.camera.empty()) find_camera(scene, request.pose.camera);
    const Fit fit{.width = request.grid.width(), .height = request.grid.height(), .fill = 1, .front = request.front};
    if (scene.units == SceneUnits::picture_widths) {
        fit_with_limited_front(scene, fit);
        const Bounds box = bounds(scene);
        scene.notes.push_back(fmt::format("its nearest point is {}, its farthest {}; --near and --far set both",
                                          place_of(-box.high.z), place_of(-box.low.z)));
    } else {
        const Bounds box = bounds(scene);
        const double scale = scene::fit_scale(box.high - box.low, fit);
        for (Mesh& mesh : scene.meshes)
            for (Vec3& position : mesh.positions) position = {scale * position.x, scale * position.y, position.z};
    }
    turn_scene(scene, request.pose);
}

/// Rotates and fits the scene of a file, or uses the view of its camera, and adds notes about these decisions.
void place_imported(Scene& scene, const LightFieldRequest& request) {
    if (scene.units != SceneUnits::any) return place_picture(scene, request);
    const ScenePose& pose = request.pose;
    const Fit fit{.width = request.grid.width(), .height = request.grid.height(), .front = request.front};
    if (!pose.camera.empty()) {
        const SceneCamera camera = find_camera(scene, pose.camera);
        const double eye = frame_scene(scene, camera, fit);
        scene.notes.push_back(eye < std::numeric_limits<double>::infinity()
                                  ? fmt::format("its camera is {} in front of the hologram", format_length(eye))
                                  : "its camera is orthographic, infinitely far in front of the hologram");
        return;
    }
    if (!request.fit) {
        scene.up = {0, 1, 0};
    } else if (scene.up == Vec3{0, 0, 1} && !pose.up) {
        scene.notes.push_back("files of this kind have z upwards; if it lies on its back, add --up y");
    }
    if (!scene.cameras.empty()) {
        std::string names;
        for (std::size_t i = 0; i < std::min<std::size_t>(scene.cameras.size(), 4); ++i)
            names += fmt::format("{}'{}'", i == 0 ? "" : ", ",
                                 scene.cameras[i].name.empty() ? fmt::format("{}", i + 1) : scene.cameras[i].name);
        scene.notes.push_back(fmt::format("it is seen from its front; --scene-camera uses the view of a camera: {}{}",
                                          names, scene.cameras.size() > 4 ? " ..." : ""));
    }
    turn_scene(scene, pose);
    if (request.fit) fit_with_limited_front(scene, fit);
}

}  // namespace

Scene load_scene(const std::string& name, const LightFieldRequest& request, const Progress& progress) {
    const core::StopScope scope(progress);
    require_built_in(request);
    if (scenes().look_up(name) != nullptr)
        return pipeline::place_built_in(make_scene(name, request.grid.width(), progress), request);
    pipeline::require_scene_file(name);
    return prepare_scene(import_scene(name, progress, request.import), request);
}

Scene prepare_scene(Scene scene, const LightFieldRequest& request) {
    const double width = request.grid.width();
    place_imported(scene, request);
    scene.has_large_triangles = has_large_triangles(scene, width);
    if (scene.lights.empty()) add_default_lights(scene);
    place_scene(scene, request.pose, width);
    note_gloss(scene, request.shading);
    return scene;
}

std::shared_ptr<const ShadedScene> light_scene(const Scene& scene, const LightFieldRequest& request,
                                               const Progress& progress) {
    const core::StopScope scope(progress);
    require_built_in(request);
    auto shaded = std::make_shared<ShadedScene>();
    shaded->fronts_only = request.cull_back_faces;
    shade_scene_into(scene, request.shading, *shaded, progress);
    if (request.cache_spacing > 0)
        shading::add_radiance_cache(
            *shaded, render::cache_spacing(*shaded, finer(request.grid, request.samples), request.cache_spacing));
    return shaded;
}

LightField render_light_field(const std::shared_ptr<const ShadedScene>& scene, const LightFieldRequest& request) {
    std::vector<LightField::Source> faces;
    for (const LightFieldGrid& grid : request.grids())
        faces.push_back(request.interpolate > 0 ? interpolated(scene, grid, request)
                                                : make_renderer(request.renderer, scene, grid, request.samples));
    Metadata entries = scene->provenance;
    entries.emplace_back("renderer", request.renderer);
    return LightField(std::move(faces), {std::move(entries), {}});
}

LightField render_light_field(const Scene& scene, const LightFieldRequest& request, const Progress& progress) {
    return render_light_field(light_scene(scene, request, progress), request);
}

LightField prepare_for_reading(const LightField& light_field, std::size_t times, bool with_depth,
                               const Progress& progress) {
    const core::StopScope scope(progress);
    const double values = light_field.samples() * (with_depth ? 4.0 / 3 : 1);
    if (times <= 1 || values * sizeof(float) > max_buffered_bytes)
        return cached_tiles(light_field, max_cached_tile_bytes, with_depth);
    std::size_t done = 0;
    return light_field.wrapped([&](const LightField::Source& face) {
        auto buffer = std::make_shared<LightFieldBuffer>(face->grid(), with_depth);
        copy(*face, *buffer, progress.part(done, light_field.faces().size()));
        ++done;
        return LightField::Source(std::move(buffer));
    });
}

void write_light_field(const std::filesystem::path& path, const LightField& light_field,
                       const LightFieldFileOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    LightFieldFileOptions file = options;
    file.metadata = with_history(file.metadata, to_metadata(light_field.provenance()));
    const auto sinks = create_light_field(path, light_field.grids(), file);
    for (std::size_t i = 0; i < sinks.size(); ++i)
        copy(*light_field.faces()[i], *sinks[i], progress.part(i, sinks.size()));
}

}  // namespace hogel
