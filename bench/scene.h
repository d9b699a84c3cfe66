// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bench/arguments.h"
#include "bench/session.h"
#include "hogel/light_field.h"
#include "hogel/pipeline.h"
#include "hogel/scene.h"
#include "hogel/shading.h"
#include "hogel/units.h"

namespace hogel::bench {

using namespace hogel::literals;

// Defaults of `hogel render`; shading is its default for built-in scenes.
inline const std::string default_algorithm{defaults.renderer}, default_shading = "vertex";
inline constexpr double default_cache_spacing = defaults.cache_spacing;

/// Options of rendering a scene. The defaults are those of `hogel render`.
struct LightFieldOptions {
    std::string algorithm = default_algorithm;
    std::string shading = default_shading;
    /// Distance of the radiance cache's points, in widths of a ray on the surface; 0: no cache.
    double cache_spacing = default_cache_spacing;
    Counts hogels{400, 400}, directions{32, 32};
    double size = 20_mm;     ///< width of the hologram
    std::size_t across = 0;  ///< number of hogels across the whole width, if `hogels` is only the middle; 0: all
    Angles field_of_view{16_deg, 16_deg};  ///< full angles

    /// Throws Error(usage) if the options are invalid.
    LightFieldGrid grid() const;
};

/// Returns a built-in scene as large as the hologram, or a mesh file fitted to it, with lights. Throws Error(usage) for
/// a name that is neither a scene nor a file.
Scene load_scene(const std::string& name, const LightFieldOptions& options);

/// Shades the scene and adds a radiance cache for the rays of the options' light field, unless cache_spacing is 0.
std::shared_ptr<const ShadedScene> shade(const Session& session, const Scene& scene, const LightFieldOptions& options);

/// Opens a light field file, or makes a renderer of a scene's light field, which renders when it is read.
std::shared_ptr<const LightFieldSource> open_or_render(const Session& session, const std::string& name,
                                                       const LightFieldOptions& options);

}  // namespace hogel::bench
