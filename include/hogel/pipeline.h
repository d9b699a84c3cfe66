// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// The whole chain from a scene or a file to photographs, with all defaults. The command line is a thin layer over it,
/// as language bindings would be; whatever two such layers need is here.

/// The defaults of all parameters; lengths in metres, angles in radians. The side of the hologram, the number of hogels
/// and the camera belong together: a hogel is at most as wide as the camera's resolution cell λR/A.
struct Defaults {
    // light field
    std::string_view renderer = "epi";
    std::string_view shading = "auto";
    std::size_t shadow_map = 512;  ///< texels along a side of each of the six faces around a point light
    double cache_spacing = 0.25;   ///< distance of the radiance cache's points, in widths of a ray on the surface
    double size = 20e-3;           ///< side of the hologram
    std::size_t hogels = 400, directions = 32;
    double field_of_view = 16 * 3.14159265358979323846 / 180;  ///< full angle, 2θ
    double front = 0.3;       ///< share of a fitted mesh's depth in front of the hologram plane
    double sqnr = 40;         ///< decibels of a compressed light field
    double tone_decades = 1;  ///< decades of luminance left by histogram tone mapping

    // baking
    std::size_t bake_rays = 256, bake_bounces = 5;

    // hologram
    double pitch = 1.5625e-6;  ///< 32 samples per hogel; small enough to diffract blue over the field of view
    std::string_view basis = "cdf97";
    double spacing = 10e-6;  ///< of points on surfaces, for methods without a light field
    std::size_t planes = 16;
    double red = 633e-9, green = 532e-9, blue = 460e-9;  ///< wavelengths

    // camera
    double eye_distance = 300e-3;
    double pupil = 6e-3;
    double focal_length = 50e-3;     ///< of a lens whose opening is given by an f-number
    double frame_rate = 12;          ///< of a movie, frames per second
    std::size_t resolution = 400;    ///< pixels across a photograph
    std::size_t looks = 16;          ///< photographs averaged to reduce speckle
    std::size_t pupil_samples = 64;  ///< points of the pupil in a photograph by rays
};
inline constexpr Defaults defaults;

/// How a scene is placed at the hologram and rendered as a light field.
struct HOGEL_API LightFieldRequest {
    std::string renderer{defaults.renderer};  ///< a name in renderers()
    ShadingOptions shading;
    /// Distance of the radiance cache's points, in widths of a ray on the surface; 0: no cache, light is evaluated for
    /// each ray. Used by shading models that evaluate light at samples (direct and shadowed).
    double cache_spacing = defaults.cache_spacing;
    LightFieldGrid grid{
        defaults.hogels,     defaults.hogels,     defaults.size / static_cast<double>(defaults.hogels),
        defaults.directions, defaults.directions, hogel::field_of_view(defaults.field_of_view)};  ///< of the front
    bool hemicube = false;  ///< all faces around `grid`: see hemicube()
    SamplesPerRay samples;
    bool cull_back_faces = false;
    bool fit = true;                ///< whether a mesh file is scaled and moved to fill the hologram
    double front = defaults.front;  ///< share of a fitted mesh's depth in front of the plane: see Fit
    ScenePose pose;                 ///< how the scene is turned, placed and lit
    ImportOptions import;           ///< how a mesh file is read
    /// Full angles that the faces of a hemicube span, radians.
    double hemicube_across = std::numbers::pi, hemicube_down = std::numbers::pi;
    /// Side of the regions between whose corners shading is interpolated, in hogels: see make_interpolating_renderer().
    /// For the renderer simplex; 0: every sample by itself.
    std::size_t interpolate = 0;

    /// The grids of all faces. Throws Error(usage) if they are invalid.
    std::vector<LightFieldGrid> grids() const;
};

/// How a light field becomes holograms, one per channel.
struct HologramRequest {
    std::vector<Channel> channels = rgb(defaults.red, defaults.green, defaults.blue);
    double pitch = defaults.pitch;  ///< of the samples, metres; rounded so that a hogel has a whole number of samples
    HologramMethod method = Fourier();
    std::size_t looks = 1;
    std::uint64_t seed = 1;
    /// Whether the light field holds coefficients of basis fringes instead of radiances: see open_for_holograms().
    bool of_coefficients = false;

    /// For one wavelength and a light field with those faces. If that has one channel, every wavelength shows it.
    HologramOptions options(const Channel& channel, std::span<const LightFieldGrid> faces) const {
        const bool grey = !faces.empty() && faces.front().channels == 1;
        return {{channel.wavelength, grey ? 0 : channel.index}, pitch, method, looks, seed};
    }
};

/// The kind of an input. A scene is the name of a built-in one or a mesh file; light fields and holograms are files. A
/// set of views that a layout recognises, a folder or a file, is a light field too.
enum class InputKind { scene, light_field, hologram };

/// The kind of the input of that name. Throws Error(usage) for an unknown name, with the nearest that exists, and
/// Error(bad_input) for a file that is missing or of another kind.
HOGEL_API InputKind input_kind(const std::string& name);

/// Opens a light field file, or imports a set of views as it is: import_views() with no options.
HOGEL_API LightField open_light_field_or_views(const std::filesystem::path& path, const Progress& progress = {});

/// Opens the light field in a file or a set of views for holograms, with_common_directions(). If the request is for
/// basis fringes and the file holds coefficients of such fringes, opens the coefficients and sets
/// request.of_coefficients.
/// @param any_transform  whether to set the request's transform to that of the file's coefficients
HOGEL_API LightField open_for_holograms(const std::filesystem::path& path, HologramRequest& request,
                                        bool any_transform);

/// Makes the built-in scene of that name in the size of the request's hologram, or reads a mesh file, fits it if
/// request.fit, and adds lights if it has none.
HOGEL_API Scene load_scene(const std::string& name, const LightFieldRequest& request, const Progress& progress = {});

/// Prepares a scene that is in memory, such as one from import_scene(), as load_scene() prepares one from a mesh file:
/// turns it, fits it if request.fit, adds lights if it has none, and places it. Throws as turn_scene(), fit_scene() and
/// place_scene() do.
HOGEL_API Scene prepare_scene(Scene scene, const LightFieldRequest& request);

/// Shades a scene for renderers and adds a radiance cache that suits the request's rays.
HOGEL_API std::shared_ptr<const ShadedScene> light_scene(const Scene& scene, const LightFieldRequest& request,
                                                         const Progress& progress = {});

/// The light field of a scene, rendered when it is read.
HOGEL_API LightField render_light_field(const std::shared_ptr<const ShadedScene>& scene,
                                        const LightFieldRequest& request);
HOGEL_API LightField render_light_field(const Scene& scene, const LightFieldRequest& request,
                                        const Progress& progress = {});

/// Every n-th hogel of a light field, across and down, for a first look at a large one: read one by one, where they
/// are. The middle of the hologram stays where it is: n must be odd, an even one takes the next odd number, and at the
/// edges up to n − 1 hogels lie outside the first and the last. A light field with too few hogels for n takes the
/// largest that it has enough for; n = 1 is the light field itself. Throws Error(usage) for 0.
HOGEL_API LightField every_nth_hogel(const LightField& light_field, std::size_t n);

/// Prepares a light field for readers that read it several times and in tiles of their own, as holograms do once per
/// channel. If it is read more than once and is small enough, it is copied into memory; otherwise it is wrapped by
/// cached_tiles(). If `with_depth`, depths are kept too.
HOGEL_API LightField prepare_for_reading(const LightField& light_field, std::size_t times, bool with_depth,
                                         const Progress& progress = {});

/// Writes all faces of a light field into one HDF5 file, tile by tile on all threads. Throws as create_light_field().
HOGEL_API void write_light_field(const std::filesystem::path& path, const LightField& light_field,
                                 const LightFieldFileOptions& options, const Progress& progress = {});

/// Writes one look of holograms into one HDF5 file, region by region on all threads. Throws as create_hologram().
HOGEL_API void write_holograms(const std::filesystem::path& path, const Fields& holograms,
                               const HologramFileOptions& options, const Progress& progress = {});

/// Checks a request before work begins. Throws Error(usage) if a light field with these grids cannot become such
/// holograms or if these cameras cannot photograph them, for example because the pitch is too coarse.
HOGEL_API void require_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                 std::span<const Camera> cameras = {});

/// A sentence for the user if holograms of the light field are possible but will show it badly; otherwise empty. With
/// the method OverlapAdd it reads the light field's depths.
HOGEL_API std::string warning_about(const LightField& light_field, const HologramRequest& request);

/// One hologram per channel, computed from the light field when it is read.
HOGEL_API Fields make_holograms(const LightField& light_field, const HologramRequest& request);

/// Photographs holograms of one or three wavelengths by wave optics and combines the colours.
HOGEL_API std::vector<Image> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                const CameraModel& model = BandCamera(), const Progress& progress = {});

/// The same by one camera.
HOGEL_API Image photograph_colours(const Fields& holograms, const Camera& camera,
                                   const CameraModel& model = BandCamera(), const Progress& progress = {});

/// The same in several ways, [way][camera]. Processes of a team then share all of them together.
HOGEL_API std::vector<std::vector<Image>> photograph_colours(const Fields& holograms, std::span<const Camera> cameras,
                                                             std::span<const CameraModel> ways,
                                                             const Progress& progress = {});

/// The quantity of a field F that a picture shows.
enum class FieldQuantity {
    intensity,  ///< |F|², the radiance of the samples' light
    amplitude,  ///< |F|
    phase,      ///< arg F as greys of a display, black at −π and white at π
    real        ///< Re F as greys of a display: 0 is the middle one, the largest |F| white, and its negative black
};

/// A picture of a field, with one channel and one pixel for each sample.
HOGEL_API Image picture_of(View<const std::complex<float>, 2> samples,
                           FieldQuantity quantity = FieldQuantity::intensity);
/// The same for one look of a field, which is read into memory. The picture has the field's provenance.
HOGEL_API Image picture_of(const FieldSource& field, FieldQuantity quantity = FieldQuantity::intensity,
                           std::size_t look = 0, const Progress& progress = {});

/// The logarithm of intensities as greys of a display: white is the brightest pixel, and black is four decades below.
HOGEL_API Image logarithmic(const Image& intensities);

/// A camera on the axis that frames a hologram of this size (metres) with `resolution` pixels across.
HOGEL_API Camera camera_for(double width, double height, std::size_t resolution = defaults.resolution);

/// The number of looks that reduces speckle as much as Defaults::looks does for the default camera. A wider pupil needs
/// fewer, because its speckle is finer and each pixel averages more of it.
HOGEL_API std::size_t enough_looks(const Camera& camera);

/// Measures of the difference of two sets of samples. All are NaN where a difference is no number.
struct SampleComparison {
    double sqnr = 0;       ///< 10 log10(Σ|f|² / Σ|f − f'|²), decibels; +infinity for equal samples
    double psnr = 0;       ///< the same with N max |f|² in place of Σ|f|², for N samples
    double max_error = 0;  ///< max |f − f'|
};

/// Compares all faces of two light fields, or all fields of two holograms (their first look). Throws Error(usage) if
/// they are sampled differently.
HOGEL_API SampleComparison compare(const LightField& a, const LightField& b, const Progress& progress = {});
HOGEL_API SampleComparison compare(const Fields& a, const Fields& b, const Progress& progress = {});

/// Options of pictures for a hologram printer.
struct PrinterImageOptions {
    bool rows = false;       ///< true: one picture per row of hogels, side by side; false: one per hogel
    bool serpentine = true;  ///< whether every second row runs from the right, for a print head that moves both ways
    double exposure = 1;     ///< factor of linear values, the same for all pictures
    Metadata metadata = {};  ///< in addition to the light field's provenance; stored only in pictures of rows, because
                             ///< those of hogels are many
};

/// Writes the directions of each hogel of the front as PNG files in a folder, numbered in the order of printing
/// ("hogel_0001.png", or "row_001.png"). Returns their names. Throws Error(usage) for an exposure that is not positive,
/// Error(cannot_write).
HOGEL_API std::vector<std::filesystem::path> write_printer_images(const std::filesystem::path& folder,
                                                                  const LightField& light_field,
                                                                  const PrinterImageOptions& options,
                                                                  const Progress& progress = {});

/// Checks an output before work begins. Throws Error(cannot_write) if its folder is missing or not writable or if it is
/// not a regular file, and Error(usage) if it is one of the inputs: files, or names of scenes.
HOGEL_API void require_writable(const std::filesystem::path& file, std::span<const std::string> inputs = {});

/// Writes a text file, which appears under its name when it is complete. Throws Error(cannot_write).
HOGEL_API void write_text(const std::filesystem::path& file, const std::string& text);

/// Identifies an input for work that can be resumed (LightFieldFileOptions::resume): its name, with the size and date
/// of a file or the checksum of a scene.
HOGEL_API std::string describe_input(const std::string& name);
HOGEL_API std::string describe_input(const std::string& name, const Scene& scene);

/// Resources to render a light field and write it to an uncompressed file. There is no estimate of the time of the
/// shading models shadowed and direct; shading_model() says what `auto` stands for.
/// @param rendered   from render_light_field(), not yet read
/// @param triangles  of its scene
HOGEL_API Plan plan_light_field(const LightField& rendered, const LightFieldRequest& request, std::size_t triangles,
                                const LightFieldFileOptions& file = {});
/// Resources to make holograms of an existing light field and write them to a file.
HOGEL_API Plan plan_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                              const HologramFileOptions& file = {});
/// The selected band source, and the reason.
struct BandSourceChoice {
    BandSource source = BandSource::samples;  ///< hogel_spectra or samples
    std::string reason;
};
/// The choice of photograph() for holograms of a light field with these faces. From hogels, whose waves all methods but
/// the exact PhaseAdded and OwnMethod know, if an eye's band has at most a quarter as many samples as a hogel, half
/// along either axis, for the widest band of all cameras and colours; otherwise from samples.
HOGEL_API BandSourceChoice choose_band_source(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                              std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Resources to photograph holograms that are computed on demand, from what choose_band_source() says.
HOGEL_API Plan plan_photographs(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                                std::span<const Camera> cameras, const CameraModel& model = BandCamera());

/// Throws Error(usage), with the numbers, if `what` needs more memory than the machine has left or more disk space than
/// is free at `file`.
HOGEL_API void require_resources(const Plan& plan, const std::string& what, const std::filesystem::path& file = {});

/// A scene before it is placed at a hologram, for programs that place and light it again and again: a mesh file is read
/// once, and a built-in scene is made again only for another size. For one thread at a time.
class HOGEL_API SceneModel {
  public:
    /// Reads a mesh file. Throws as load_scene() does.
    explicit SceneModel(std::string name, const ImportOptions& options = {}, const Progress& progress = {});

    /// Whether it comes from a mesh file, so that LightFieldRequest::fit and LightFieldRequest::front act.
    bool is_file() const { return imported_.has_value(); }
    /// The scene of load_scene() with this request, whose `import` is that of the constructor. Throws as that does.
    Scene placed(const LightFieldRequest& request, const Progress& progress = {});

  private:
    std::string name_;
    std::optional<Scene> imported_, made_;
    double made_for_ = 0;  // side of the hologram of `made_`, metres
};

/// A parameter whose value keeps a hologram from showing a scene as it could, and the value that would do.
struct Advice {
    std::string parameter;  ///< "pitch", "directions" or "hogels", as options of the command line
    std::string text;       ///< one sentence, with the numbers
    double enough = 0;      ///< what would do with the other parameters as they are: metres, or a number across
    bool refused = false;   ///< whether there is no such hologram at all; otherwise it is less sharp than its hogels
};

/// What of a scene a light field and its holograms cannot show with these parameters.
///
/// * pitch: samples of pitch p diffract the wavelength λ to sin θ = λ/(2p) at most; steeper rays would alias. The pitch
///   is rounded so that a hogel has a whole number of samples, and `enough` is a pitch that needs no rounding.
/// * directions: at depth ζ the rays of neighbouring directions are |ζ|ΔU apart. Where that is more than a hogel,
/// details
///   of a hogel's size are lost ([K] 2.3).
/// * hogels: a hogel of width d diffracts light of wavelength λ into λ/d, which at depth ζ is |ζ|λ/d wide. Where that
/// is
///   more than the hogel itself, fewer and larger hogels, √(λ|ζ|) wide, show it more sharply.
///
/// @param scene  as it is placed; its nearest and farthest depths count
HOGEL_API std::vector<Advice> advise(const Bounds& scene, const LightFieldRequest& light_field,
                                     const HologramRequest& hologram);

/// The pitch of a request, or where that does not diffract the field of view of the one face, the `enough` of advise(),
/// metres. The sides of a hemicube show what no pitch diffracts: of several faces it is the pitch of the request.
HOGEL_API double diffracting_pitch(std::span<const LightFieldGrid> faces, const HologramRequest& hologram);

/// A part of a light field or hologram file that several programs write without knowing of each other: number `number`,
/// from 1, of `count`. A part holds some of the rows of hogels of every face, or some of the rows of samples of every
/// field, and the header of the whole file.
struct FilePart {
    std::size_t number = 1, count = 1;
    /// What the parts must have in common beside the options in the metadata: the input.
    std::string input = {};
};

/// Writes a part of what write_light_field() would write. Part files are no HDF5 files: join_parts() makes one of them
/// all. Throws Error(usage) if there are more parts than rows of hogels, and what write_light_field() throws.
HOGEL_API void write_light_field_part(const std::filesystem::path& path, const LightField& light_field,
                                      const LightFieldFileOptions& options, const FilePart& part,
                                      const Progress& progress = {});

/// Writes a part of what write_holograms() would write, in rows of samples that begin and end with hogels. Throws
/// Error(usage) if there are more parts than rows of hogels, and what write_holograms() throws.
HOGEL_API void write_holograms_part(const std::filesystem::path& path, const Fields& holograms,
                                    const HologramFileOptions& options, const FilePart& part,
                                    const Progress& progress = {});

/// Joins the parts of a file, in any order. The file has the same bytes as one that was written whole. Throws
/// Error(bad_input) if a part is missing, given twice, of another file or damaged, and Error(cannot_write).
HOGEL_API void join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path> parts,
                          const Progress& progress = {});

}  // namespace hogel
