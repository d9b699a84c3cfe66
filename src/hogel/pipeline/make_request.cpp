// SPDX-License-Identifier: Apache-2.0
// Values selected by the recipe: planes in focus, viewpoints, looks, the pitch, and speckle-free photographs.
#include <fmt/format.h>

#include <algorithm>

#include "hogel/error.h"
#include "hogel/make.h"
#include "hogel/units.h"

namespace hogel {
namespace {

std::vector<NamedCamera> default_cameras(const MakeRequest& request, const Bounds& scene) {
    const LightFieldGrid& grid = request.light_field.grid;
    std::vector<NamedCamera> cameras;
    for (const NamedFocus& focus : default_focuses(scene, request.eye_distance))
        for (const NamedEye& eye : default_eyes(grid, request.eye_distance, request.pupil)) {
            Camera camera = camera_for(grid.width(), grid.height(), request.resolution);
            camera.eye = eye.position;
            camera.focus_depth = focus.depth;
            camera.pupil = request.pupil;
            cameras.push_back({eye.name, focus.name, camera});
        }
    return cameras;
}

}  // namespace

std::array<NamedFocus, 2> default_focuses(const Bounds& scene, double eye_distance) {
    const double front = -scene.high.z, back = -scene.low.z, sixth = (back - front) / 6;
    return {NamedFocus{"near", std::max(front + sixth, -0.5 * eye_distance)}, NamedFocus{"far", back - sixth}};
}

std::array<NamedEye, 3> default_eyes(const LightFieldGrid& grid, double eye_distance, double pupil) {
    const double half_width = 0.5 * grid.pitch * static_cast<double>(std::max(grid.hogels_s, grid.hogels_t));
    const double margin = half_width + 0.5 * pupil, tangent = std::min(grid.half_u(), grid.half_v());
    const double max_offset = eye_distance * tangent - margin;
    if (!(max_offset > 0))
        throw Error(ErrorCode::usage, "eye_distance",
                    fmt::format("at {} the field of view does not cover the whole hologram; it does beyond {}",
                                format_length(eye_distance), format_length(margin / tangent)));
    const double offset = 0.7 * max_offset, z = eye_distance;
    return {NamedEye{"left", {-offset, 0, z}}, NamedEye{"high", {0, offset, z}}, NamedEye{"right", {offset, 0, z}}};
}

MakeRequest resolve(MakeRequest request, const Bounds& scene) {
    std::vector<LightFieldGrid> faces = request.light_field.grids();
    if (request.cameras.empty()) request.cameras = default_cameras(request, scene);
    for (const NamedCamera& named : request.cameras) validate(named.camera);
    if (std::holds_alternative<SpeckleFreeCamera>(request.camera))
        request.hologram.looks = 1;
    else if (request.hologram.looks == 0)
        request.hologram.looks = enough_looks(request.cameras.front().camera);
    std::ranges::transform(faces, faces.begin(), common_directions);
    if (request.adapt_pitch) request.hologram.pitch = diffracting_pitch(faces, request.hologram);
    return request;
}

std::vector<Camera> cameras_of(const MakeRequest& request) {
    std::vector<Camera> cameras;
    for (const NamedCamera& named : request.cameras) cameras.push_back(named.camera);
    return cameras;
}

bool is_speckle_free_cheap(std::span<const LightFieldGrid> faces, const HologramRequest& hologram,
                           std::span<const Camera> cameras, const CameraModel& model) {
    const auto* const fourier = std::get_if<Fourier>(&hologram.method);
    if (fourier == nullptr || fourier->phases != Phases::random) return false;
    const double looks = plan_photographs(faces, hologram, cameras, model).seconds,
                 speckle_free = plan_photographs(faces, hologram, cameras, SpeckleFreeCamera()).seconds;
    return speckle_free <= std::max(10.0, looks);
}

}  // namespace hogel
