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
#include "scene_options.h"
#include "session.h"

namespace hogel::cli {

/// The options of rendering a scene.
struct RenderOptions {
    std::string algorithm{defaults.renderer};
    std::string shading{defaults.shading};
    std::size_t shadow_map = defaults.shadow_map;
    double cache_spacing = defaults.cache_spacing;
    Counts hogels{defaults.hogels, defaults.hogels};
    Counts directions{defaults.directions, defaults.directions};
    Counts samples{1, 1};  ///< per ray: along a hogel's side, along a side of a direction's cell
    double size = defaults.size;
    Angles field_of_view{defaults.field_of_view, defaults.field_of_view};
    bool field_of_view_given = false;  ///< otherwise a hemicube spans 180 degrees
    Angles toward;
    bool hemicube = false;
    double focal_plane = 0;          ///< depth of a fixed focal plane, metres
    bool focal_plane_given = false;  ///< otherwise hogels have the same directions
    double frequencies = 0;          ///< wavelength whose frequency grid gives the directions, metres; 0: perspective
    bool as_is = false;
    std::size_t interpolate = 0;     ///< side of the regions of hogels, with `interpolate_given`
    bool interpolate_given = false;  ///< otherwise every sample is shaded by itself
    bool fronts_only = false;        ///< whether back faces are culled
    double front = defaults.front;
    SceneOptions scene;

    // What decides which options act, known once a light field is rendered.
    bool is_rendered = false, has_shadow_maps = false, is_lit_by_samples = false;

    /// The grid of the front. Throws Error(usage).
    LightFieldGrid grid() const;
    LightFieldRequest request() const;
    /// With the shading model that `auto` stands for.
    LightFieldRequest request(const Scene& loaded) const;
};
void add_render_options(Command& command, RenderOptions& options);
/// --hemicube, for commands that use all faces.
void add_hemicube_option(Command& command, RenderOptions& options);
/// --focal-plane, --frequencies and --interpolate, for the command that makes light fields.
void add_direction_options(Command& command, RenderOptions& options);

/// The options of a hologram of a light field.
struct HologramChoices {
    std::vector<double> wavelengths;
    double pitch = defaults.pitch;
    std::string method = "fourier";  ///< a row of hologram_methods()
    std::string phase;               ///< empty: the default of the method
    std::string average = "radiance";
    std::string basis;  ///< empty: that of the light field's coefficients, or else cdf97
    double tolerance = 0;
    double spacing = defaults.spacing;
    std::size_t planes = defaults.planes;
    double lines = 0;  ///< distance of the lines of the method lines, metres; 0: that of samples

    HologramMethod hologram_method() const;
    HologramRequest request(const Session& session, std::size_t looks) const;

    // What decides which options act, known once a hologram is made, or a field with a pitch and wavelengths is read.
    bool is_made = false, is_sampled = false;
    std::optional<HologramMethod> made_by;  ///< of a light field
    bool is_seeded = false;                 ///< whether looks differ, so that their number acts on a photograph
    bool has_spacing = false, has_planes = false;

    /// Sets the values with which a hologram of a light field with this front is made.
    void resolve(const HologramRequest& request, const LightFieldGrid& front);
};
/// As hogel::require_holograms(), whose errors name only parameters that act here.
/// @param rendered  whether a scene becomes the light field by options, too
void check_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request, bool rendered,
                     std::span<const Camera> cameras = {});
void add_hologram_options(Command& command, HologramChoices& options);
/// As add_hologram_options(), and those of methods that compute the hologram of a scene without a light field.
void add_scene_hologram_options(Command& command, HologramChoices& options);

// The functions that follow set the values of options that act, and what decides which do.

/// The request of load_scene(), with how the scene is turned, placed and lit. Throws Error(usage).
LightFieldRequest scene_request(const RenderOptions& options);
/// A built-in scene in the size of the hologram, or a mesh file, fitted to it if requested, with lights.
Scene load_scene(const Session& session, const std::string& name, RenderOptions& options);

/// Shades the scene and prints the resources that this takes.
std::shared_ptr<const ShadedScene> light_scene(const Session& session, const Scene& scene, RenderOptions& options);

/// The light field of a scene, rendered when it is read.
LightField render_light_field(const Session& session, const Scene& scene, RenderOptions& options);

/// Throws Error(usage) where rendering would take more memory than there is.
void require_memory(const Session& session, const LightField& rendered, const RenderOptions& options,
                    const Scene& scene);

/// The light field of a file, or of a scene, which is rendered when it is read.
LightField open_or_render(const Session& session, const std::string& name, RenderOptions& options);

/// See prepare_for_reading() in hogel/pipeline.h.
LightField prepare_for_reading(const Session& session, const LightField& light_field, std::size_t times,
                               bool with_depth);

}  // namespace hogel::cli
