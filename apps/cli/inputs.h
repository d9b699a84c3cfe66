// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "defaults.h"
#include "hogel/camera.h"
#include "hogel/files.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/photograph.h"
#include "hogel/renderer.h"
#include "hogel/scene.h"
#include "hogel/shading.h"
#include "session.h"

namespace hogel::cli {

/// How a scene becomes a light field.
struct RenderOptions {
    std::string algorithm{defaults.algorithm};
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

    /// Of the front face.
    LightFieldGrid grid() const;
    /// Of all faces: the front alone, or all five.
    std::vector<LightFieldGrid> grids() const;
    SamplesPerRay samples_per_ray() const { return {samples.columns, samples.rows}; }
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
    double lines = 0;           ///< distance of lines with horizontal parallax only, metres; 0: both parallaxes
    bool coefficients = false;  ///< whether the light field holds coefficients of `basis` instead of radiances
};
void add_hologram_options(Command& command, HologramChoices& options);
/// These, and more for methods that make the hologram of a scene without a light field.
void add_scene_hologram_options(Command& command, HologramChoices& options);

/// What the user may name as the input of a command: a light field, a hologram, or a scene (a built-in one or a mesh
/// file). Throws Error(usage) for an unknown scene and Error(bad_input) for a file that is missing or none of these.
enum class InputKind { scene, light_field, hologram };
InputKind input_kind(const std::string& name);

/// A built-in scene as big as the hologram, or a mesh file fitted to it (or as it is), lit.
Scene load_scene(const Session& session, const std::string& name, const RenderOptions& options);

/// A scene with its light, which unless cache_spacing is 0 is kept on the surfaces for rays of the options' light
/// field.
std::shared_ptr<const ShadedScene> shade_scene(const Session& session, const Scene& scene,
                                               const RenderOptions& options);

/// The light field of a scene, rendered where it is read.
std::unique_ptr<LightFieldSource> render_on_demand(const Session& session, const Scene& scene,
                                                   const RenderOptions& options);

/// The light field that a name stands for: the file's, or the scene's, rendered where it is read.
std::unique_ptr<LightFieldSource> open_or_render(const Session& session, const std::string& name,
                                                 const RenderOptions& options);

/// All faces of a light field in a file, or coefficients instead where a compressed one has those of the basis fringes
/// that are asked for, which the options then say.
std::vector<std::unique_ptr<LightFieldSource>> open_for_hologram(const std::string& name, HologramChoices& hologram);

/// All faces of a light field that is rendered where it is read, the front first; or those of either kind.
std::vector<std::unique_ptr<LightFieldSource>> render_faces_on_demand(const Session& session, const Scene& scene,
                                                                      const RenderOptions& options);
std::vector<std::unique_ptr<LightFieldSource>> open_or_render_faces(const Session& session, const std::string& name,
                                                                    const RenderOptions& options);

/// Whether holograms like this need the depth of every ray.
bool needs_depth(const HologramChoices& options);

/// Faces of a light field that will be read so many times in tiles that suit the reader, such as holograms, which read
/// it once a colour: rendered in tiles that suit the renderer, and kept, whole and before, where there are several
/// times and they fit into a modest part of memory. With their depths if asked.
std::vector<std::unique_ptr<LightFieldSource>> render_for_reading(const Session& session,
                                                                  std::vector<std::unique_ptr<LightFieldSource>> faces,
                                                                  std::size_t times, bool with_depth);

std::vector<LightFieldGrid> grids_of(std::span<const std::unique_ptr<LightFieldSource>> faces);

/// Throws Error(usage) where a light field sampled like this cannot become such holograms, or these cameras cannot
/// photograph them: too coarse a pitch, say. To be asked before the work begins.
void require_holograms(std::span<const LightFieldGrid> faces, const HologramChoices& options,
                       std::span<const Camera> cameras = {});

/// One hologram a wavelength, made from the light field where it is read.
std::vector<std::unique_ptr<FieldSource>> make_holograms(const Session& session,
                                                         std::span<const std::unique_ptr<LightFieldSource>> faces,
                                                         const HologramChoices& options, std::size_t looks);

/// Photographs holograms of one or three wavelengths by wave optics and joins the colours. With options for it by the
/// full chain of plane waves, otherwise by the narrow band.
std::vector<Image> photograph_colours(Stage& stage, std::span<const std::unique_ptr<FieldSource>> holograms,
                                      std::span<const Camera> cameras,
                                      const std::optional<FullCameraOptions>& full = {});

/// A camera that frames a hologram of this size with so many pixels across.
Camera camera_for(double width, double height, std::size_t resolution);

}  // namespace hogel::cli
