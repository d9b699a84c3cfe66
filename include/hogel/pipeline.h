// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/bake.h"
#include "hogel/camera.h"
#include "hogel/compress.h"
#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/photograph.h"
#include "hogel/progress.h"
#include "hogel/propagate.h"
#include "hogel/ray_photograph.h"
#include "hogel/renderer.h"
#include "hogel/scenes.h"
#include "hogel/shading.h"

namespace hogel {

/// The whole recipe, from a scene or a file to photographs, with every default. The command line is a thin layer over
/// it, and so are bindings: what two of them would need stands here.

/// Every number that the recipe takes where the caller says none; lengths in metres, angles in radians. The hologram's
/// side, its hogels and the sharpness of a photograph belong together: a hogel is as wide as what the camera resolves,
/// λR/A, or less.
struct Defaults {
    // light field
    std::string_view renderer = "epi";
    std::string_view shading = "vertex";
    std::size_t shadow_map = 512;  ///< texels along a side of each of the six faces around a lamp
    double cache_spacing = 0.25;   ///< of the points of the radiance cache, in widths of a ray on the surface
    double size = 20e-3;           ///< side of the hologram
    std::size_t hogels = 400, directions = 32;
    double field_of_view = 16 * 3.14159265358979323846 / 180;  ///< full angle, 2θ
    double front = 0.3;                                        ///< how much of a fitted mesh stands before the plane
    double sqnr = 40;                                          ///< decibels of a compressed light field
    double tone_decades = 1;                                   ///< decades of luminance left by histogram tone mapping

    // baking
    std::size_t bake_rays = 256, bake_bounces = 5;

    // hologram
    double pitch = 1.5625e-6;  ///< 32 samples a hogel; blue must still be diffracted over the field of view
    std::string_view basis = "cdf97";
    double spacing = 10e-6;  ///< of points on surfaces, for methods without a light field
    std::size_t planes = 16;
    double red = 633e-9, green = 532e-9, blue = 460e-9;  ///< wavelengths

    // camera
    double eye_distance = 300e-3;
    double pupil = 6e-3;
    double focal_length = 50e-3;     ///< of a lens whose opening is given as an f-number
    double frame_rate = 12;          ///< of a film, frames a second
    std::size_t resolution = 400;    ///< pixels across a photograph
    std::size_t looks = 16;          ///< photographs averaged against speckle
    std::size_t pupil_samples = 64;  ///< points of the pupil in a photograph by rays
};
inline constexpr Defaults defaults;

/// How a scene is put before the hologram and becomes a light field.
struct HOGEL_API LightFieldRequest {
    std::string renderer{defaults.renderer};  ///< a name in renderers()
    ShadingOptions shading;
    /// Distance of the radiance cache's points in parts of the width of a ray on the surface, where light is evaluated
    /// at samples (shading models direct and shadowed); 0: light is evaluated anew for each ray.
    double cache_spacing = defaults.cache_spacing;
    LightFieldGrid grid{
        defaults.hogels,     defaults.hogels,     defaults.size / static_cast<double>(defaults.hogels),
        defaults.directions, defaults.directions, hogel::field_of_view(defaults.field_of_view)};  ///< of the front
    bool hemicube = false;  ///< all faces around `grid`: see hemicube()
    SamplesPerRay samples;
    bool cull_back_faces = false;
    bool fit = true;                ///< whether a mesh file is scaled and moved to fill the hologram
    double front = defaults.front;  ///< how much of a fitted mesh's depth stands before the plane: see Fit

    /// The grids of all faces. Throws Error(usage) where they make no sense.
    std::vector<LightFieldGrid> grids() const;
};

/// How a light field becomes holograms, one a channel.
struct HologramRequest {
    std::vector<Channel> channels = rgb(defaults.red, defaults.green, defaults.blue);
    double pitch = defaults.pitch;  ///< of the samples, metres; rounded to divide a hogel
    HologramMethod method = Fourier();
    std::size_t looks = 1;
    std::uint64_t seed = 1;
    /// Whether the light field holds coefficients of basis fringes instead of radiances: see open_for_holograms().
    bool of_coefficients = false;

    HologramOptions options(const Channel& channel) const { return {channel, pitch, method, looks, seed}; }
};

/// What may stand for an input: the name of a built-in scene, a mesh file, a light field or a hologram in a file.
enum class InputKind { scene, light_field, hologram };

/// Throws Error(usage) for an unknown name, with the nearest that exists, and Error(bad_input) for a file that is
/// missing or none of these.
HOGEL_API InputKind input_kind(const std::string& name);

/// The light field in a file, for holograms. Where the request is for basis fringes and the file holds coefficients of
/// such fringes, these, and the request then says so.
/// @param any_transform  whether the request takes over the transform that the file's coefficients are of
HOGEL_API LightField open_for_holograms(const std::filesystem::path& path, HologramRequest& request,
                                        bool any_transform);

/// The scene of that name as large as the request's hologram, or a mesh file fitted to it (or as it is), with lights.
HOGEL_API Scene load_scene(const std::string& name, const LightFieldRequest& request, const Progress& progress = {});

/// The scene ready for renderers: shaded, and with a radiance cache that suits the request's rays.
HOGEL_API std::shared_ptr<const ShadedScene> light_scene(const Scene& scene, const LightFieldRequest& request,
                                                         const Progress& progress = {});

/// The light field of a scene, rendered where it is read.
HOGEL_API LightField render_light_field(std::shared_ptr<const ShadedScene> scene, const LightFieldRequest& request);
HOGEL_API LightField render_light_field(const Scene& scene, const LightFieldRequest& request,
                                        const Progress& progress = {});

/// A light field that will be read several times, in tiles that suit the reader, such as holograms, which read it once
/// a channel: whole in memory where it fits into a modest part of it, otherwise in tiles that suit its source, the last
/// of which are kept. With its depths if asked.
HOGEL_API LightField prepare_for_reading(const LightField& light_field, std::size_t times, bool with_depth,
                                         const Progress& progress = {});

/// Writes all faces of a light field into one HDF5 file, in tiles, on all threads. Errors as create_light_field().
HOGEL_API void write_light_field(const std::filesystem::path& path, const LightField& light_field,
                                 const LightFieldFileOptions& options, const Progress& progress = {});

/// Writes one look of holograms into one HDF5 file, likewise. Errors as create_hologram().
HOGEL_API void write_holograms(const std::filesystem::path& path, const Fields& holograms,
                               const HologramFileOptions& options, const Progress& progress = {});

/// Throws Error(usage) where a light field sampled like this cannot become such holograms, or these cameras cannot
/// photograph them: too coarse a pitch, say. To be asked before work begins.
HOGEL_API void require_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                 std::span<const Camera> cameras = {});

/// A sentence for the user where holograms can be made of a light field but will show it badly; otherwise empty. Reads
/// the depths of a light field for overlapping windows.
HOGEL_API std::string warning_about(const LightField& light_field, const HologramRequest& request);

/// One hologram a channel, made from the light field where it is read.
HOGEL_API Fields make_holograms(const LightField& light_field, const HologramRequest& request);

/// Photographs holograms of one or three wavelengths by wave optics and joins the colours. With options for it by the
/// full chain of plane waves, otherwise by the narrow-band camera.
HOGEL_API std::vector<Image> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                const std::optional<PlaneWaveCameraOptions>& full = {},
                                                const Progress& progress = {});

/// A camera on the axis that frames a hologram of this size (metres) with so many pixels across.
HOGEL_API Camera camera_for(double width, double height, std::size_t resolution = defaults.resolution);

/// As many looks as make speckle as fine as the usual camera's usual number does. A wide pupil sees finer speckle, of
/// which the pixels average more by themselves.
HOGEL_API std::size_t enough_looks(const Camera& camera);

/// How alike two sets of samples are.
struct SampleComparison {
    double sqnr = 0;       ///< 10 log10(Σ|f|² / Σ|f − f'|²), decibels; +infinity for equal samples
    double psnr = 0;       ///< the same with N max |f|² for the signal
    double max_error = 0;  ///< max |f − f'|
};

/// Compares all faces of two light fields, or all fields of two holograms (their first look). Throws Error(usage) where
/// they are sampled differently.
HOGEL_API SampleComparison compare(const LightField& a, const LightField& b, const Progress& progress = {});
HOGEL_API SampleComparison compare(const Fields& a, const Fields& b, const Progress& progress = {});

/// How a light field becomes pictures for a hologram printer.
struct PrinterImageOptions {
    bool rows = false;       ///< one picture a row of hogels, side by side, rather than one a hogel
    bool serpentine = true;  ///< whether every second row runs from the right, as a head does that goes back and forth
    double exposure = 1;     ///< what linear values are multiplied by, the same in all pictures
    Metadata metadata = {};  ///< beside the light field's provenance; in pictures of rows alone: hogels are many
};

/// Writes the directions of each hogel of the front as PNG files in a folder, numbered in the order of printing
/// ("hogel_0001.png", or "row_001.png"). Returns their names. Throws Error(usage) for an exposure that is not positive,
/// Error(cannot_write).
HOGEL_API std::vector<std::filesystem::path> write_printer_images(const std::filesystem::path& folder,
                                                                  const LightField& light_field,
                                                                  const PrinterImageOptions& options,
                                                                  const Progress& progress = {});

/// Throws Error(cannot_write), before hours of work, for an output whose folder is missing or not writable, or that is
/// there and is no plain file.
HOGEL_API void require_writable(const std::filesystem::path& file);

/// Writes a whole file, which appears under its name when it is complete. Throws Error(cannot_write).
HOGEL_API void write_text(const std::filesystem::path& file, const std::string& text);

/// What tells an input of work that is resumed from another: its name, and the size and date of a file, or a checksum
/// of all that a scene shows.
HOGEL_API std::string describe_input(const std::string& name);
HOGEL_API std::string describe_input(const std::string& name, const Scene& scene);

/// What work will take, before it begins.
struct Plan {
    double memory = 0;   ///< bytes at most at any time
    double disk = 0;     ///< bytes of the files that it writes
    double seconds = 0;  ///< estimated, on as many threads as loops use at present
};

/// What it takes to render a light field and write it to a file, uncompressed.
/// @param rendered   from render_light_field(), not yet read
/// @param triangles  of its scene
HOGEL_API Plan plan_light_field(const LightField& rendered, const LightFieldRequest& request, std::size_t triangles,
                                const LightFieldFileOptions& file = {});
/// What it takes to synthesise holograms of a light field that is at hand and write them.
HOGEL_API Plan plan_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                              const HologramFileOptions& file = {});
/// What it takes to photograph holograms that are not stored, by the narrow-band camera.
HOGEL_API Plan plan_photographs(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                std::span<const Camera> cameras, const PhotographOptions& options = {});

/// What it takes to compress a light field, reading it aside. Disk is a bound: a coder that predicts nothing takes that
/// much for an SQNR.
HOGEL_API Plan plan_compression(const LightField& light_field, const CompressionOptions& options);
/// What it takes to propagate fields one after the other and write them to a file.
HOGEL_API Plan plan_propagation(std::span<const FieldGrid> fields, const PropagateOptions& options = {});

/// Throws Error(usage) with the numbers where `what` needs more memory than the machine has left, or more disk than is
/// free where `file` will stand.
HOGEL_API void require_resources(const Plan& plan, const std::string& what, const std::filesystem::path& file = {});

}  // namespace hogel
