// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/camera.h"
#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/photograph.h"
#include "hogel/pipeline.h"
#include "hogel/progress.h"
#include "hogel/scene.h"

namespace hogel {

/// make() turns a scene into a hologram and photographs it by wave optics and by rays, from several viewpoints. It
/// selects omitted viewpoints, planes in focus, looks (speckle realisations) and pitch, and a common exposure.

/// A named plane in focus.
struct NamedFocus {
    std::string name;
    double depth = 0;  ///< ζ, metres
};

/// A named viewpoint.
struct NamedEye {
    std::string name;
    Vec3 position;  ///< metres
};

/// A named camera of make().
struct NamedCamera {
    std::string eye_name, focus_name;
    Camera camera;

    /// Names of the picture files without extension: "photo_left_near" by wave optics, with "_expected" for
    /// speckle-free photographs and "_geometric" for photographs by rays.
    std::string wave_file() const { return "photo_" + eye_name + "_" + focus_name; }
    std::string speckle_free_file() const { return wave_file() + "_expected"; }
    std::string ray_file() const { return wave_file() + "_geometric"; }
};

/// Returns two planes in focus. "near" is a sixth of the scene's depth behind its nearest point, but at most half-way
/// to the viewpoint. "far" is a sixth in front of its farthest point. `eye_distance` is in metres.
HOGEL_API std::array<NamedFocus, 2> default_focuses(const Bounds& scene, double eye_distance);

/// Returns three viewpoints: "left", "high" and "right". Their distance from the axis is 0.7 of the largest at which
/// every hogel sends rays to the whole pupil. Lengths are in metres. Throws Error(usage) if hogels do not fill the
/// pupil even on the axis.
HOGEL_API std::array<NamedEye, 3> default_eyes(const LightFieldGrid& grid, double eye_distance, double pupil);

/// Parameters of make(). resolve() completes omitted values.
struct MakeRequest {
    LightFieldRequest light_field;
    HologramRequest hologram{.looks = 0};  ///< looks = 0: enough_looks()
    /// Whether to reduce the pitch of `hologram` if it does not diffract the field of view.
    bool adapt_pitch = true;
    /// Camera model of photographs by wave optics. SpeckleFreeCamera makes only the speckle-free ones.
    CameraModel camera = BandCamera();
    /// Whether to add speckle-free photographs. Empty: if is_speckle_free_cheap().
    std::optional<bool> speckle_free;
    RayCamera rays{defaults.pupil_samples};
    double eye_distance = defaults.eye_distance;   ///< metres
    double pupil = defaults.pupil;                 ///< metres
    std::size_t resolution = defaults.resolution;  ///< pixels across
    /// Empty: default_eyes(), each with default_focuses(). The second camera determines the exposure.
    std::vector<NamedCamera> cameras;
};

/// Returns the request with pitch, cameras and number of looks. Throws Error(usage) as default_eyes() does, and for an
/// invalid grid or camera.
/// @param scene  bounds of the scene as placed at the hologram
HOGEL_API MakeRequest resolve(MakeRequest request, const Bounds& scene);

/// Returns the cameras without their names.
HOGEL_API std::vector<Camera> cameras_of(const MakeRequest& request);

/// Returns whether speckle-free photographs take no longer than those of all looks, or at most ten seconds. They are
/// slow for large hogels, which send many waves into the pupil. Returns false if SpeckleFreeCamera refuses.
HOGEL_API bool is_speckle_free_cheap(std::span<const LightFieldGrid> faces, const HologramRequest& hologram,
                                     std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Files and progress reports of make().
struct MakeOptions {
    /// HDF5 file to write the light field to and read it from. Empty: it is kept in memory, with samples of the type of
    /// `light_field`, or rendered repeatedly if it does not fit (prepare_for_reading()).
    std::filesystem::path light_field_file = {};
    std::filesystem::path hologram_file = {};  ///< HDF5 file for the hologram; empty: none
    LightFieldFileOptions light_field = {};    ///< of the light field's file
    HologramFileOptions hologram = {};         ///< of the hologram's file
    /// Called at the beginning of each stage with its name; returns the Progress of the stage. Empty: make()'s Progress
    /// in equal parts.
    std::function<Progress(const std::string& stage)> stage = {};
};

/// A photograph by wave optics, compared with the photograph by rays at the common exposure.
struct ComparedImage {
    Image image;
    ImageComparison comparison;
};

/// The photographs of one camera of make().
struct MadePhotographs {
    NamedCamera camera;
    Image rays;  ///< one channel per wavelength of the hologram, as `waves`
    std::optional<ComparedImage> waves, speckle_free;
};

/// The results of make().
struct Made {
    MakeRequest request;     ///< as completed by resolve()
    LightField light_field;  ///< in memory or in its file
    Fields holograms;        ///< one per wavelength, computed when read
    double exposure = 1;     ///< of all pictures
    std::vector<MadePhotographs> photographs;
};

/// Renders a scene, makes its hologram and photographs it. The pictures do not depend on where the light field is kept.
/// With a ResumeScope, interrupted work can be continued. Ranks (communicator.h) share the work. Throws Error(usage) as
/// resolve(), require_holograms() and photograph() do.
/// @param scene  as placed by load_scene() or prepare_scene()
HOGEL_API Made make(const Scene& scene, const MakeRequest& request = {}, const MakeOptions& options = {},
                    const Progress& progress = {});

/// Does the same for a light field, such as one from render_light_field() or import_views(). Throws Error(usage) for a
/// request without cameras or looks.
/// @param request  from resolve(), or with explicit cameras and looks
HOGEL_API Made make(const LightField& light_field, const MakeRequest& request, const MakeOptions& options = {},
                    const Progress& progress = {});

/// Metadata of the picture files, in addition to each picture's provenance and the exposure.
struct MadeMetadata {
    Metadata waves, speckle_free, rays;
};

/// Writes all photographs into a folder as PNG and EXR files, named as NamedCamera defines. Throws Error(cannot_write).
HOGEL_API void write_photographs(const std::filesystem::path& folder, const Made& made,
                                 const MadeMetadata& metadata = {}, const Progress& progress = {});

}  // namespace hogel
