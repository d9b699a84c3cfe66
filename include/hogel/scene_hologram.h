// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/shading.h"
#include "hogel/table.h"

namespace hogel {

/// Options of SceneHologramMethod::make().
struct SceneHologramOptions {
    std::size_t channel = 0;  ///< the channel of the scene's colours that this wavelength shows
    std::uint64_t seed = 1;   ///< of the random phases that make surfaces diffuse
    double spacing = 10e-6;   ///< distance of points on surfaces and along edges, metres; at most 10⁸ points
    std::size_t planes = 16;  ///< number of depth planes, for methods that use them
};

/// A method that computes the field on the hologram plane directly from a scene, without a light field, after [K]
/// chapter 3. These methods are references and baselines for stereograms. The field is normalised like a stereogram's
/// (docs/notation.md, section 3), so that a photograph of it shows radiance. make() works on all threads, returns a
/// field completely in memory, and gives the same bytes for any number of threads. It throws Error(usage) for a scene
/// or grid that the method cannot process, and names one that it can.
struct SceneHologramMethod {
    std::string name;
    std::string text;  ///< one line
    std::function<Field(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                        const Progress& progress)>
        make;
    bool uses_spacing = false;  ///< whether SceneHologramOptions::spacing acts
    bool uses_planes = false;   ///< whether SceneHologramOptions::planes acts
};

/// The holograms of one scene that a method is to make.
struct SceneHologramRequest {
    std::string method;                         ///< a row of scene_hologram_methods()
    std::vector<FieldGrid> grids;               ///< one for each wavelength
    std::vector<SceneHologramOptions> options;  ///< one for each grid
};

/// The holograms of one scene that a method makes for several wavelengths, each written to its sink, which is finished.
/// The processes of a team (team.h) take a wavelength each.
/// @param options  one for each grid
/// Throws as the method does.
HOGEL_API void write_scene_holograms(const SceneHologramMethod& method, const ShadedScene& scene,
                                     std::span<const FieldGrid> grids, std::span<const SceneHologramOptions> options,
                                     std::span<const std::unique_ptr<FieldSink>> sinks, const Progress& progress = {});

/// All methods by name, and those that a program adds.
HOGEL_API Table<SceneHologramMethod>& scene_hologram_methods();

}  // namespace hogel
