// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "hogel/pipeline.h"
#include "session.h"

namespace hogel::cli {

/// How a scene becomes a light field.
struct RenderOptions {
    std::string algorithm{defaults.renderer};
    std::string shading{defaults.shading};
    std::size_t shadow_map = defaults.shadow_map;
    double cache_spacing = defaults.cache_spacing;
    Counts hogels{defaults.hogels, defaults.hogels};
    Counts directions{defaults.directions, defaults.directions};
    Counts samples{1, 1};  ///< of a ray: along a hogel, along a direction's cell
    double size = defaults.size;
    Angles field_of_view{defaults.field_of_view, defaults.field_of_view};
    Angles toward;
    bool hemicube = false;
    double frequencies = 0;  ///< wavelength on whose frequency grid the directions lie, metres; 0: in perspective
    bool as_is = false;
    bool fronts_only = false;  ///< whether back faces are culled
    double front = defaults.front;

    /// How the front is sampled. Throws Error(usage).
    LightFieldGrid grid() const;
    LightFieldRequest request() const;
};
void add_render_options(Command& command, RenderOptions& options);
/// --hemicube, for commands that make use of all faces.
void add_hemicube_option(Command& command, RenderOptions& options);
/// --frequencies, for the command that makes light fields.
void add_frequencies_option(Command& command, RenderOptions& options);

/// How a light field becomes a hologram.
struct HologramChoices {
    std::vector<double> wavelengths;
    double pitch = defaults.pitch;
    std::string method = "fourier";
    std::string phase;  ///< empty: what suits the method
    std::string average = "radiance";
    std::string basis;  ///< empty: the one that the light field's coefficients are of, or else cdf97
    double tolerance = 0;
    double spacing = defaults.spacing;
    std::size_t planes = defaults.planes;
    double lines = 0;  ///< distance of lines with horizontal parallax only, metres; 0: both parallaxes

    HologramMethod hologram_method() const;
    HologramRequest request(const Session& session, std::size_t looks) const;
};
/// As hogel::require_holograms(), whose errors then name the options.
/// @param rendered  whether a scene becomes the light field by options, too
void check_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request, bool rendered,
                     std::span<const Camera> cameras = {});
void add_hologram_options(Command& command, HologramChoices& options);
/// These, and more for methods that make the hologram of a scene without a light field.
void add_scene_hologram_options(Command& command, HologramChoices& options);

/// A built-in scene as big as the hologram, or a mesh file fitted to it (or as it is), with lights.
Scene load_scene(const Session& session, const std::string& name, const RenderOptions& options);

/// The scene shaded, with words about what that takes.
std::shared_ptr<const ShadedScene> light_scene(const Session& session, const Scene& scene,
                                               const RenderOptions& options);

/// The light field of a scene, rendered where it is read.
LightField render_light_field(const Session& session, const Scene& scene, const RenderOptions& options);

/// Throws Error(usage) where rendering would take more memory than there is.
void require_memory(const LightField& rendered, const RenderOptions& options, const Scene& scene);

/// The light field that a name stands for: the file's, or the scene's, rendered where it is read.
LightField open_or_render(const Session& session, const std::string& name, const RenderOptions& options);

/// See prepare_for_reading() in hogel/pipeline.h.
LightField prepare_for_reading(const Session& session, const LightField& light_field, std::size_t times,
                               bool with_depth);

}  // namespace hogel::cli
