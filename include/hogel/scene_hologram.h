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
    std::size_t channel = 0;  ///< channel of the scene's colours for this wavelength
    std::uint64_t seed = 1;   ///< of the random phases of diffuse surfaces
    double spacing = 10e-6;   ///< distance of points on surfaces and along edges, metres; at most 10⁸ points
    std::size_t planes = 16;  ///< number of depth planes, for methods that use them
};

/// A method that computes the field on the hologram plane directly from a scene, without a light field ([K] chapter 3).
/// These methods are references and baselines for stereograms. The field is normalised like that of a stereogram
/// (docs/notation.md, section 3), so a photograph of it shows radiance. make() runs on all threads, returns a field in
/// memory, and gives the same bytes for any number of threads. It throws Error(usage) for a scene or grid that the
/// method does not support; the message names a method that does.
struct SceneHologramMethod {
    std::string name;
    std::string text;  ///< one line
    std::function<Field(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                        const Progress& progress)>
        make;
    bool uses_spacing = false;  ///< whether the method uses SceneHologramOptions::spacing
    bool uses_planes = false;   ///< whether the method uses SceneHologramOptions::planes
};

/// Parameters of the holograms of one scene, one per wavelength.
struct SceneHologramRequest {
    std::string method;                         ///< name of a row of scene_hologram_methods()
    std::vector<FieldGrid> grids;               ///< one per wavelength
    std::vector<SceneHologramOptions> options;  ///< one per grid
};

/// Computes the holograms of one scene for several wavelengths, and writes each to its sink and finishes it. Ranks
/// (communicator.h) compute one wavelength each at a time. Throws as the method does.
/// @param options  one per grid
/// @param sinks    one per grid
HOGEL_API void write_scene_holograms(const SceneHologramMethod& method, const ShadedScene& scene,
                                     std::span<const FieldGrid> grids, std::span<const SceneHologramOptions> options,
                                     std::span<const std::unique_ptr<FieldSink>> sinks, const Progress& progress = {});

/// Returns all methods by name, and those that the program adds.
HOGEL_API Table<SceneHologramMethod>& scene_hologram_methods();

}  // namespace hogel
