// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hogel/camera.h"
#include "hogel/compress.h"
#include "hogel/exchange.h"
#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/hologram.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/photograph.h"
#include "hogel/progress.h"
#include "hogel/propagate.h"
#include "hogel/renderer.h"
#include "hogel/resources.h"
#include "hogel/scene.h"
#include "hogel/shading.h"

namespace hogel {

/// The full chain from a scene or a file to photographs, with all defaults. Command line and Python are thin layers
/// over it.

/// Default parameters; lengths in metres, angles in radians. The side of the hologram, the number of hogels and the
/// camera belong together: a hogel is at most as wide as the camera's resolution cell λR/A.
struct Defaults {
    // light field
    std::string_view renderer = "epi";
    std::string_view shading = "auto";
    std::size_t shadow_map = 512;  ///< texels along a side of each of the six faces around a point light
    double cache_spacing = 0.25;   ///< distance of the radiance cache's points, in ray widths on the surface
    double size = 20e-3;           ///< side of the hologram
    std::size_t hogels = 400, directions = 32;
    double field_of_view = 16 * 3.14159265358979323846 / 180;  ///< full angle, 2θ
    double front = 0.3;       ///< fraction of a fitted mesh's depth in front of the hologram plane
    double sqnr = 40;         ///< decibels of a compressed light field
    double tone_decades = 1;  ///< decades of luminance after histogram tone mapping

    // baking
    std::size_t bake_rays = 256, bake_bounces = 5;

    // hologram
    double pitch = 1.5625e-6;  ///< 32 samples per hogel; diffracts blue over the field of view
    std::string_view basis = "cdf97";
    double spacing = 10e-6;  ///< of points on surfaces, for methods without a light field
    std::size_t planes = 16;
    double red = 633e-9, green = 532e-9, blue = 460e-9;  ///< wavelengths

    // camera
    double eye_distance = 300e-3;
    double pupil = 6e-3;
    double focal_length = 50e-3;     ///< of a lens with a given f-number
    double frame_rate = 12;          ///< of a film, frames per second
    std::size_t resolution = 400;    ///< pixels across a photograph
    std::size_t looks = 16;          ///< number of looks (speckle realisations) averaged in a photograph
    std::size_t pupil_samples = 64;  ///< points of the pupil in a photograph by rays
};
inline constexpr Defaults defaults;

/// Parameters of placing a scene at the hologram and rendering it as a light field.
struct HOGEL_API LightFieldRequest {
    std::string renderer{defaults.renderer};  ///< name of a row of renderers()
    ShadingOptions shading;
    /// Distance of the radiance cache's points, in ray widths on the surface; 0: no cache, light is evaluated for each
    /// ray. For shading models that evaluate light at samples (direct and shadowed).
    double cache_spacing = defaults.cache_spacing;
    LightFieldGrid grid{
        defaults.hogels,     defaults.hogels,     defaults.size / static_cast<double>(defaults.hogels),
        defaults.directions, defaults.directions, hogel::field_of_view(defaults.field_of_view)};  ///< of the front
    bool hemicube = false;  ///< all faces around `grid`, see hemicube()
    SamplesPerRay samples;
    bool cull_back_faces = false;
    bool fit = true;                ///< whether a mesh file is scaled and moved to fill the hologram; true for pictures
    double front = defaults.front;  ///< fraction of a fitted mesh's depth in front of the plane, see Fit
    ScenePose pose;                 ///< orientation, position, colours and lights of the scene
    ImportOptions import;           ///< for a file
    /// Full angles that the faces of a hemicube span, radians.
    double hemicube_across = std::numbers::pi, hemicube_down = std::numbers::pi;
    /// Side of the regions of hogels with interpolated shading, see make_interpolating_renderer(); 0: every sample is
    /// shaded. For the renderer simplex.
    std::size_t interpolate = 0;

    /// Returns the grids of all faces. Throws Error(usage) if they are invalid.
    std::vector<LightFieldGrid> grids() const;
};

/// Parameters of the holograms of a light field, one per channel.
struct HologramRequest {
    std::vector<Channel> channels = rgb(defaults.red, defaults.green, defaults.blue);
    double pitch = defaults.pitch;  ///< of the samples, metres; rounded to a whole number of samples per hogel
    HologramMethod method = Fourier();
    std::size_t looks = 1;
    std::uint64_t seed = 1;
    /// Whether the light field has coefficients of basis fringes instead of radiances, see open_for_holograms().
    bool of_coefficients = false;

    /// Returns the options of one wavelength, for a light field with these faces. All wavelengths show a single
    /// channel.
    HologramOptions options(const Channel& channel, std::span<const LightFieldGrid> faces) const {
        const bool grey = !faces.empty() && faces.front().channels == 1;
        return {{channel.wavelength, grey ? 0 : channel.index}, pitch, method, looks, seed};
    }
};

/// Kinds of inputs. A scene is a built-in name, a mesh file, or a picture that is no field (is_external_field()). A
/// light field is a file, or a set of views (folder or file) that a layout recognises. A hologram is a file.
enum class InputKind { scene, light_field, hologram };

/// Returns the kind of the input of this name. Throws Error(usage) for an unknown name, with the nearest existing name,
/// and Error(bad_input) for a file that is missing or of another kind.
HOGEL_API InputKind input_kind(const std::string& name);

/// Opens a light field file, or imports a set of views with default options.
HOGEL_API LightField open_light_field_or_views(const std::filesystem::path& path, const Progress& progress = {});

/// Opens a light field file or a set of views, and resamples it by with_common_directions(). A request for basis
/// fringes may instead use the coefficients of basis fringes in a stream of the coder "fringes": then the function
/// opens the coefficients and sets request.of_coefficients. Streams with a tone curve, coarser chrominance, a fixed
/// focal plane or another layout than faces are always opened as radiances.
/// @param any_transform  true: opens coefficients of any transform, and sets the request's transform to it; false:
///                       opens coefficients only if they have the request's transform
HOGEL_API LightField open_for_holograms(const std::filesystem::path& path, HologramRequest& request,
                                        bool any_transform);

/// Makes the built-in scene of this name for the size of the request's hologram and applies the pose, or reads a mesh
/// or picture file and calls prepare_scene(). Throws Error(usage) for an unknown name, Error(bad_input) for a missing
/// file, and as import_scene(), turn_scene() and place_scene() do.
HOGEL_API Scene load_scene(const std::string& name, const LightFieldRequest& request, const Progress& progress = {});

/// Prepares a scene in memory, such as one from import_scene(): turns it, fits it if request.fit, adds lights if it has
/// none, and places it. A picture fills the hologram's width or height and is then turned about its middle
/// (SceneUnits). Throws as turn_scene(), fit_scene() and place_scene() do.
HOGEL_API Scene prepare_scene(Scene scene, const LightFieldRequest& request);

/// Shades a scene for renderers, and adds a radiance cache that suits the request's rays.
HOGEL_API std::shared_ptr<const ShadedScene> light_scene(const Scene& scene, const LightFieldRequest& request,
                                                         const Progress& progress = {});

/// Returns the light field of a scene, rendered when it is read.
HOGEL_API LightField render_light_field(const std::shared_ptr<const ShadedScene>& scene,
                                        const LightFieldRequest& request);
HOGEL_API LightField render_light_field(const Scene& scene, const LightFieldRequest& request,
                                        const Progress& progress = {});

/// Returns a light field of every n-th hogel, across and down, for a preview of a large one. Hogels are read one by one
/// from the original. n must be odd to keep the centre of the hologram; an even n is increased by one. Up to n − 1
/// hogels lie beyond the first and the last selected one. If there are too few hogels, the largest possible n is used.
/// n = 1 returns the light field itself. Throws Error(usage) for 0.
HOGEL_API LightField every_nth_hogel(const LightField& light_field, std::size_t n);

/// Prepares a light field for readers that read it several times in tiles of other sizes, as holograms do once per
/// channel. If `times` > 1 and it needs at most 2 GB, it is copied into memory, with depth if `with_depth`; otherwise
/// cached_tiles() wraps it with 1 GB.
HOGEL_API LightField prepare_for_reading(const LightField& light_field, std::size_t times, bool with_depth,
                                         const Progress& progress = {});

/// Writes all faces of a light field into an HDF5 file, tile by tile on all threads. Throws as create_light_field().
HOGEL_API void write_light_field(const std::filesystem::path& path, const LightField& light_field,
                                 const LightFieldFileOptions& options, const Progress& progress = {});

/// Writes one look of holograms into one HDF5 file, region by region on all threads. Throws as create_hologram() does.
HOGEL_API void write_holograms(const std::filesystem::path& path, const Fields& holograms,
                               const HologramFileOptions& options, const Progress& progress = {});

/// Checks a request before work begins. Throws Error(usage) if a light field with these grids cannot become such
/// holograms, or if these cameras cannot photograph them; for example if the pitch is too coarse.
HOGEL_API void require_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                 std::span<const Camera> cameras = {});

/// Returns a sentence for the user if holograms of the light field are possible but of poor quality; otherwise an empty
/// text. Reads the light field's depth with the method OverlapAdd.
HOGEL_API std::string warning_about(const LightField& light_field, const HologramRequest& request);

/// Returns one hologram per channel, computed from the light field when it is read.
HOGEL_API Fields make_holograms(const LightField& light_field, const HologramRequest& request);

/// Photographs holograms of one or three wavelengths by wave optics and combines the colours. One image per camera.
HOGEL_API std::vector<Image> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                const CameraModel& model = BandCamera(), const Progress& progress = {});

/// Photographs with one camera.
HOGEL_API Image photograph_colours(const Fields& holograms, const Camera& camera,
                                   const CameraModel& model = BandCamera(), const Progress& progress = {});

/// Photographs with several camera models; returns [model][camera]. Ranks (communicator.h) share them.
HOGEL_API std::vector<std::vector<Image>> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                             std::span<const CameraModel> models,
                                                             const Progress& progress = {});

/// The quantity of a field F in a picture.
enum class FieldQuantity {
    intensity,  ///< |F|², the radiance of the samples' light
    amplitude,  ///< |F|
    phase,      ///< arg F in display greys: black at −π, white at π
    real        ///< Re F in display greys: 0 is mid-grey, the largest |F| white, its negative black
};

/// Returns a picture of a field, with one channel and one pixel per sample.
HOGEL_API Image picture_of(View<const std::complex<float>, 2> samples,
                           FieldQuantity quantity = FieldQuantity::intensity);
/// Returns a picture of one look of a field, which is read into memory. The picture has the field's provenance.
HOGEL_API Image picture_of(const FieldSource& field, FieldQuantity quantity = FieldQuantity::intensity,
                           std::size_t look = 0, const Progress& progress = {});

/// Returns the logarithm of intensities in display greys: white is the brightest pixel, black four decades below.
HOGEL_API Image logarithmic(const Image& intensities);

/// Returns a camera on the axis that frames a hologram of this size (metres) with `resolution` pixels across.
HOGEL_API Camera camera_for(double width, double height, std::size_t resolution = defaults.resolution);

/// Returns the number of looks that reduces speckle as much as Defaults::looks does for the default camera. A wider
/// pupil needs fewer, because its speckle is finer and each pixel averages more of it.
HOGEL_API std::size_t enough_looks(const Camera& camera);

/// Measures of the difference between two sets of samples. All are NaN if a difference is NaN.
struct SampleComparison {
    double sqnr = 0;       ///< 10 log10(Σ|f|² / Σ|f − f'|²), decibels; +infinity for equal samples
    double psnr = 0;       ///< the same with N max |f|² in place of Σ|f|², for N samples
    double max_error = 0;  ///< max |f − f'|
};

/// Compares all faces of two light fields, or the first looks of two holograms. Throws Error(usage) for other sampling.
HOGEL_API SampleComparison compare(const LightField& a, const LightField& b, const Progress& progress = {});
HOGEL_API SampleComparison compare(const Fields& a, const Fields& b, const Progress& progress = {});

/// Options of write_printer_images().
struct PrinterImageOptions {
    bool rows = false;       ///< true: one picture per row of hogels, side by side; false: one per hogel
    bool serpentine = true;  ///< every second row from right to left, for print heads that move both ways
    bool planes = false;     ///< a grey picture for each channel instead of one in colours
    bool mirror_columns = false, mirror_rows = false;  ///< of the directions in a hogel's picture
    bool transpose = false;                            ///< exchanges columns and rows of directions, after the mirror
    double exposure = 1;  ///< factor of linear values, the same for all pictures; 0: automatic_exposure()
    std::array<double, 3> dose{1, 1, 1};       ///< factors of R, G and B in addition to the exposure
    unsigned bits = 8;                         ///< of samples: 8 or 16
    Transfer transfer = Transfer::srgb;        ///< from light to samples
    std::vector<double> table = {};            ///< samples, 0 to 1, of evenly spaced light from 0 to 1, for `transfer`
    bool circle = false;                       ///< directions outside the ellipse in the picture are black
    Array<float, 2> mask = Array<float, 2>();  ///< factors 0 to 1 [v][u], scaled to the directions; empty: none
    /// In addition to the light field's provenance; only in the manifest and in pictures of rows, because pictures of
    /// hogels are numerous.
    Metadata metadata = {};
};

/// The result of write_printer_images().
struct PrinterImages {
    std::size_t pictures = 0;
    std::filesystem::path first, last;  ///< in printing order
    std::filesystem::path manifest;     ///< manifest.json, docs/printing.md
    double exposure = 1;
    std::uint64_t bytes = 0;                 ///< of the pictures
    std::uint64_t samples = 0, clipped = 0;  ///< samples of the pictures, and those brighter than white
};

/// Writes the directions of each hogel of the front as PNG files in a folder, numbered in printing order
/// ("hogel_0001.png", or "row_001.png"), and manifest.json. Above 4,096 pictures they are in folders ("part_0001"), one
/// a row of hogels. A ResumeScope continues with the first incomplete folder. Throws Error(usage) for an exposure, dose
/// or table that is not positive, Error(bad_input) for radiance that is not finite, and Error(cannot_write).
HOGEL_API PrinterImages write_printer_images(const std::filesystem::path& folder, const LightField& light_field,
                                             const PrinterImageOptions& options, const Progress& progress = {});

/// Checks an output before work begins. Throws Error(cannot_write) if its folder is missing or not writable or if it is
/// not a regular file, and Error(usage) if it is one of `inputs` (files or names of scenes).
HOGEL_API void require_writable(const std::filesystem::path& file, std::span<const std::string> inputs = {});

/// Writes a text file, which appears under its name when it is complete. Throws Error(cannot_write).
HOGEL_API void write_text(const std::filesystem::path& file, const std::string& text);

/// Returns text that identifies an input of work that can be continued (LightFieldFileOptions::resume): its name, with
/// size and date of a file or the checksum of a scene.
HOGEL_API std::string describe_input(const std::string& name);
HOGEL_API std::string describe_input(const std::string& name, const Scene& scene);

/// Estimates the resources to render a light field and write it to an uncompressed file. Time is not estimated for the
/// shading models shadowed and direct; shading_model() returns the model that `auto` selects.
/// @param rendered   from render_light_field(), not yet read
/// @param triangles  number of triangles of its scene
HOGEL_API Plan plan_light_field(const LightField& rendered, const LightFieldRequest& request, std::size_t triangles,
                                const LightFieldFileOptions& file = {});
/// Estimates the resources to make holograms of an existing light field and write them to a file.
HOGEL_API Plan plan_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                              const HologramFileOptions& file = {});
/// The selected band source, and the reason.
struct BandSourceChoice {
    BandSource source = BandSource::samples;  ///< hogel_spectra or samples
    std::string reason;
};
/// Returns the band source that photograph() selects for holograms of a light field with these faces. It is
/// hogel_spectra if the method has hogel spectra (all but the exact PhaseAdded and OwnMethod), and if the pupil band
/// has at most a quarter as many samples as a hogel, half along each axis. The widest band counts.
HOGEL_API BandSourceChoice choose_band_source(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                              std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Estimates the resources to photograph holograms computed on demand, with the source of choose_band_source().
HOGEL_API Plan plan_photographs(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Throws Error(usage), with the numbers, if `what` exceeds the free memory, or the free disk space at `file`.
HOGEL_API void require_resources(const Plan& plan, const std::string& what, const std::filesystem::path& file = {});

/// A scene that has not been placed at a hologram, for programs that place and light it repeatedly. A file is read
/// once; a built-in scene is made again only for another size. Not thread-safe.
class HOGEL_API SceneModel {
  public:
    /// Reads a mesh or picture file. Throws as load_scene() does.
    explicit SceneModel(std::string name, const ImportOptions& options = {}, const Progress& progress = {});

    /// Returns whether it is from a file, and not a picture at its own depths; only then LightFieldRequest::fit and
    /// LightFieldRequest::front have an effect.
    bool is_file() const { return imported_ && imported_->units != SceneUnits::depths; }
    /// Returns the scene of load_scene() for this request, with the constructor's `import` options. Throws as
    /// load_scene().
    Scene placed(const LightFieldRequest& request, const Progress& progress = {});

  private:
    std::string name_;
    std::optional<Scene> imported_, made_;
    double made_for_ = 0;  // side of the hologram of `made_`, metres
};

/// A parameter that limits the quality of a hologram, and a value that suffices.
struct Advice {
    std::string parameter;  ///< "pitch", "directions" or "hogels", as options of the command line
    std::string text;       ///< one sentence, with the numbers
    double enough = 0;      ///< value that suffices with the other parameters unchanged: metres, or a number across
    bool refused = false;   ///< true: there is no such hologram; false: it is less sharp than its hogels
};

/// Returns the sampling limits that a scene exceeds, in its light field and holograms.
///
/// * pitch: samples of pitch p diffract the wavelength λ to sin θ = λ/(2p) at most; steeper rays would alias. The pitch
///   is rounded to a whole number of samples per hogel; `enough` is a pitch that needs no rounding.
/// * directions: at depth ζ the rays of neighbouring directions are |ζ|ΔU apart. If that exceeds a hogel, details of a
///   hogel's size are lost ([K] 2.3).
/// * hogels: a hogel of width d diffracts light of wavelength λ into λ/d, which at depth ζ is |ζ|λ/d wide. If that
///   exceeds d, fewer and larger hogels, √(λ|ζ|) wide, give a sharper hologram.
///
/// @param scene  as placed; its nearest and farthest depths count
HOGEL_API std::vector<Advice> advise(const Bounds& scene, const LightFieldRequest& light_field,
                                     const HologramRequest& hologram);

/// Returns the pitch of the request, metres; or, if that does not diffract the field of view of a single face, the
/// `enough` of advise(). For several faces it is the request's: no pitch diffracts a whole hemicube.
HOGEL_API double diffracting_pitch(std::span<const LightFieldGrid> faces, const HologramRequest& hologram);

/// A part of a light field or hologram file, for programs that write parts independently. A part has some of the rows
/// of hogels of every face, or some of the rows of samples of every field, and the header of the complete file.
struct FilePart {
    std::size_t number = 1, count = 1;  ///< part `number`, from 1, of `count`
    /// Identifies the input, which must be the same for all parts, as must the options in the metadata.
    std::string input = {};
};

/// Writes a part of the file of write_light_field(). Part files are not HDF5 files; join_parts() combines them into
/// one. Throws as write_light_field() does, and Error(usage) if there are more parts than rows of hogels.
HOGEL_API void write_light_field_part(const std::filesystem::path& path, const LightField& light_field,
                                      const LightFieldFileOptions& options, const FilePart& part,
                                      const Progress& progress = {});

/// Writes a part of the file of write_holograms(), in rows of samples that begin and end with hogels. Throws as
/// write_holograms() does, and Error(usage) if there are more parts than rows of hogels.
HOGEL_API void write_holograms_part(const std::filesystem::path& path, const Fields& holograms,
                                    const HologramFileOptions& options, const FilePart& part,
                                    const Progress& progress = {});

/// Joins the parts of a file, in any order, into the same bytes as a file written at once. Throws Error(bad_input) if a
/// part is missing, given twice, of another file or damaged, and Error(cannot_write).
HOGEL_API void join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path> parts,
                          const Progress& progress = {});

}  // namespace hogel
