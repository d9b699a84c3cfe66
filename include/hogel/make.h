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

/// The whole recipe in one call: make() turns a scene into a hologram, and photographs it by waves and by rays from
/// several eyes. It chooses the eyes, the planes in focus, the number of looks and the pitch where the request leaves
/// them out, and one exposure for all pictures.

/// A plane in focus.
struct NamedFocus {
    std::string name;
    double depth = 0;  ///< ζ, metres
};

/// The centre of a lens.
struct NamedEye {
    std::string name;
    Vec3 position;  ///< metres
};

/// A camera of make().
struct NamedCamera {
    std::string eye_name, focus_name;
    Camera camera;

    /// The names of its picture files, without extension: "photo_left_near" by waves, with "_expected" without speckle,
    /// and with "_geometric" by rays.
    std::string wave_file() const { return "photo_" + eye_name + "_" + focus_name; }
    std::string speckle_free_file() const { return wave_file() + "_expected"; }
    std::string ray_file() const { return wave_file() + "_geometric"; }
};

/// Two planes in focus: "near", a sixth of the scene's depth behind its nearest point, but at most half-way to the eye;
/// and "far", as much in front of its farthest point.
HOGEL_API std::array<NamedFocus, 2> default_focuses(const Bounds& scene, double eye_distance);

/// Three eyes: "left", "high" and "right". They are at 0.7 of the distance from the axis up to which every hogel sends
/// rays to the whole pupil. Throws Error(usage) if that is not even so on the axis.
HOGEL_API std::array<NamedEye, 3> default_eyes(const LightFieldGrid& grid, double eye_distance, double pupil);

/// What make() is asked for. resolve() chooses what is left out.
struct MakeRequest {
    LightFieldRequest light_field;
    HologramRequest hologram{.looks = 0};  ///< looks = 0: enough_looks()
    /// Whether to take a smaller pitch than that of `hologram` where that does not diffract the field of view.
    bool adapt_pitch = true;
    /// The camera of the photographs by waves. With SpeckleFreeCamera only the speckle-free ones are made.
    CameraModel camera = BandCamera();
    /// Whether there are photographs without speckle too; none: where is_speckle_free_cheap().
    std::optional<bool> speckle_free;
    RayCamera rays{defaults.pupil_samples};
    double eye_distance = defaults.eye_distance;   ///< metres
    double pupil = defaults.pupil;                 ///< metres
    std::size_t resolution = defaults.resolution;  ///< pixels across
    /// Empty: default_eyes(), each with the default_focuses(). The second one sets the exposure.
    std::vector<NamedCamera> cameras;
};

/// The request with its pitch, its cameras and its number of looks. Throws Error(usage) as default_eyes() does, and for
/// an invalid grid or camera.
/// @param scene  as it is placed at the hologram
HOGEL_API MakeRequest resolve(MakeRequest request, const Bounds& scene);

/// The cameras without their names.
HOGEL_API std::vector<Camera> cameras_of(const MakeRequest& request);

/// Whether photographs without speckle take no longer than those of the looks, or no more than ten seconds. They take
/// long where many waves of a hogel enter the pupil: where hogels are large. False for holograms that
/// SpeckleFreeCamera refuses.
HOGEL_API bool is_speckle_free_cheap(std::span<const LightFieldGrid> faces, const HologramRequest& hologram,
                                     std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Where make() keeps what is large, and who is told of its stages.
struct MakeOptions {
    /// HDF5 file that the light field is written to and read from. Empty: it is kept in memory, with samples of the
    /// type of `light_field`, or rendered again where it does not fit (prepare_for_reading()).
    std::filesystem::path light_field_file = {};
    std::filesystem::path hologram_file = {};  ///< HDF5 file that the hologram is written to; empty: none
    LightFieldFileOptions light_field = {};    ///< of the light field's file
    HologramFileOptions hologram = {};         ///< of the hologram's file
    /// Called at the beginning of each stage with its name; the result is the stage's Progress. Empty: stages are equal
    /// parts of the Progress of make().
    std::function<Progress(const std::string& stage)> stage = {};
};

/// A photograph by waves, compared with that by rays at the exposure of all.
struct ComparedImage {
    Image image;
    ImageComparison comparison;
};

/// The photographs of make() by one camera.
struct MadePhotographs {
    NamedCamera camera;
    Image rays;  ///< one channel for each wavelength of the hologram, as `waves`
    std::optional<ComparedImage> waves, speckle_free;
};

/// What make() has made.
struct Made {
    MakeRequest request;     ///< as resolve() completed it
    LightField light_field;  ///< in memory or in its file
    Fields holograms;        ///< one per wavelength, computed when they are read
    double exposure = 1;     ///< of all pictures
    std::vector<MadePhotographs> photographs;
};

/// Renders a scene, makes its hologram and photographs it. The pictures do not depend on where the light field is kept.
/// While a ResumeScope exists, interrupted work can be continued. Processes of a team share the work. Throws
/// Error(usage) as resolve(), require_holograms() and photograph() do.
/// @param scene  as load_scene() or prepare_scene() places it
HOGEL_API Made make(const Scene& scene, const MakeRequest& request = {}, const MakeOptions& options = {},
                    const Progress& progress = {});

/// The same for a light field, such as one from render_light_field() or import_views(). Throws Error(usage) for a
/// request without cameras or looks.
/// @param request  from resolve(), or with cameras and looks of its own
HOGEL_API Made make(const LightField& light_field, const MakeRequest& request, const MakeOptions& options = {},
                    const Progress& progress = {});

/// What picture files say beside the picture's provenance and the exposure.
struct MadeMetadata {
    Metadata waves, speckle_free, rays;
};

/// Writes all photographs into a folder as PNG and EXR files, whose names are those of NamedCamera. Throws
/// Error(cannot_write).
HOGEL_API void write_photographs(const std::filesystem::path& folder, const Made& made,
                                 const MadeMetadata& metadata = {}, const Progress& progress = {});

}  // namespace hogel
