// SPDX-License-Identifier: Apache-2.0
// Scenes that are placed repeatedly, and the sampling limits that they exceed.
#include "hogel/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hogel/core/stop_scope.h"
#include "hogel/pipeline/scene_placing.h"
#include "hogel/stereogram/diffraction.h"
#include "hogel/units.h"

namespace hogel {

using namespace literals;

namespace {

// Returns a length rounded to three digits, or rounded down.
std::string about(double metres, bool below = false) {
    const double unit = std::pow(10, std::floor(std::log10(metres)) - 2), digits = metres / unit;
    return format_length((below ? std::floor(digits) : std::round(digits)) * unit);
}

// Returns the greatest distance of a scene from the hologram plane, metres.
double greatest_depth(const Bounds& scene) { return std::max(std::abs(scene.low.z), std::abs(scene.high.z)); }

void advise_pitch(const LightFieldGrid& grid, const HologramRequest& hologram, std::vector<Advice>& all) {
    const double shortest = std::ranges::min_element(hologram.channels, {}, &Channel::wavelength)->wavelength;
    const double possible = stereogram::max_pitch(grid, shortest);
    const std::size_t samples = stereogram::samples_per_hogel(grid, hologram.pitch);
    const double pitch = grid.pitch / static_cast<double>(samples);
    // With a pitch above two hogels, a hogel has no sample.
    if (pitch <= possible && hologram.pitch <= 2 * grid.pitch) return;
    const double enough = grid.pitch / std::ceil(grid.pitch / possible * (1 - 1e-12));
    all.push_back(
        {"pitch",
         fmt::format("a pitch of {} aliases: it diffracts {} no farther than {:.2f} degrees, but the light "
                     "field reaches {:.2f}; {} would do",
                     about(pitch), format_length(shortest), std::asin(std::min(shortest / (2 * pitch), 1.0)) / 1_deg,
                     std::asin(stereogram::steepest_sine(grid)) / 1_deg, about(enough, true)),
         enough, true});
}

void advise_directions(const LightFieldGrid& grid, double depth, std::vector<Advice>& all) {
    const double apart = depth * std::max(grid.step_u(), grid.step_v());
    if (apart <= grid.pitch * (1 + 1e-9)) return;
    const double enough = std::ceil(static_cast<double>(grid.directions_u) * apart / grid.pitch * (1 - 1e-12));
    all.push_back(
        {"directions",
         fmt::format("at a depth of {} neighbouring directions are {} apart, {:.2g} hogels; {:.0f} directions "
                     "would do",
                     about(depth), about(apart), apart / grid.pitch, enough),
         enough, false});
}

void advise_hogels(const LightFieldGrid& grid, double depth, const HologramRequest& hologram,
                   std::vector<Advice>& all) {
    const double longest = std::ranges::max_element(hologram.channels, {}, &Channel::wavelength)->wavelength;
    const double blur = longest * depth / grid.pitch;
    if (blur <= grid.pitch * (1 + 1e-9)) return;
    const double enough = std::floor(grid.width() / std::sqrt(longest * depth) * (1 + 1e-12));
    if (enough < 1) return;
    all.push_back({"hogels",
                   fmt::format("by waves, hogels of {} blur a depth of {} to {}; {:.0f} hogels of {} would do",
                               about(grid.pitch), about(depth), about(blur), enough, about(grid.width() / enough)),
                   enough, false});
}

}  // namespace

double diffracting_pitch(std::span<const LightFieldGrid> faces, const HologramRequest& hologram) {
    std::vector<Advice> advice;
    if (faces.size() == 1) advise_pitch(faces.front(), hologram, advice);
    return advice.empty() ? hologram.pitch : advice.front().enough;
}

SceneModel::SceneModel(std::string name, const ImportOptions& options, const Progress& progress)
    : name_(std::move(name)) {
    const core::StopScope scope(progress);
    if (scenes().look_up(name_) != nullptr) return;
    pipeline::require_scene_file(name_);
    imported_ = import_scene(name_, progress, options);
}

Scene SceneModel::placed(const LightFieldRequest& request, const Progress& progress) {
    if (imported_) return prepare_scene(*imported_, request);
    const double width = request.grid.width();
    if (!made_ || made_for_ != width) {
        made_ = make_scene(name_, width, progress);
        made_for_ = width;
    }
    return pipeline::place_built_in(*made_, request);
}

std::vector<Advice> advise(const Bounds& scene, const LightFieldRequest& light_field, const HologramRequest& hologram) {
    std::vector<Advice> all;
    const double depth = greatest_depth(scene);
    if (hologram.channels.empty()) return all;
    const LightFieldGrid front = light_field.grids().front();
    // The sides of a hemicube show the directions that the front's samples do not diffract.
    if (!light_field.hemicube) advise_pitch(front, hologram, all);
    advise_directions(front, depth, all);
    advise_hogels(front, depth, hologram, all);
    return all;
}

}  // namespace hogel
