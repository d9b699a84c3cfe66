// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/shading.h"

namespace hogel {

struct SceneHologramOptions {
    std::size_t channel = 0;  ///< of the scene's colours, the one that this wavelength shows
    std::uint64_t seed = 1;   ///< of the random phases that make surfaces diffuse
    double spacing = 10e-6;   ///< of points on surfaces and along edges, metres
    std::size_t planes = 16;  ///< methods of depth planes: how many
};

/// A way from a scene straight to the field on the hologram's plane, by Kartch's chapter 3: references and baselines
/// for stereograms. The field is normalised like a stereogram's (docs/notation.md, section 3), so a photograph of it
/// shows radiance. Whole in memory. All threads; the same bytes for any number of them.
/// Throws Error(usage) for what the method cannot do, with what would do.
struct SceneMethod {
    std::string_view name;
    std::string_view description;  ///< one line
    Field (*make)(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                  const Progress& progress);
};

/// All of them.
std::span<const SceneMethod> scene_methods();

/// The one of that name, or null.
const SceneMethod* find_scene_method(std::string_view name);

}  // namespace hogel
