// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/camera.h"
#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/make.h"
#include "hogel/parameters.h"
#include "hogel/pattern.h"
#include "hogel/phase_code.h"
#include "hogel/photograph.h"
#include "hogel/pipeline.h"
#include "hogel/propagate.h"
#include "hogel/scene_hologram.h"

namespace hogel {

// Parameters that commands share, from which a request is made. Each struct holds their values, with the defaults,
// declares them in a table, which it must outlive, and makes the request.

/// A light of --light, "X,Y,Z:COLOUR:STRENGTH": the direction that it comes from, its colour (default: white) and its
/// irradiance. Throws Error(usage).
HOGEL_API Light parse_light(const std::string& text);
/// The text of which parse_light() makes this light, to the last bit of its direction; empty if there is none.
HOGEL_API std::string light_text(const Light& light);

/// The parameters of a scene: how it is turned, placed, coloured and lit.
struct HOGEL_API SceneParameters {
    ScenePose pose;  ///< without `lights` and `texture`
    std::vector<std::string> lights;
    std::string texture;  ///< name of a picture
    double point_size = 1;

    /// With the lights and the picture. Throws Error(usage) for a light that is not one, and what read_image() throws.
    ScenePose complete_pose() const;
    /// Notes what decides which parameters act.
    /// @param is_from_file  it is no built-in scene
    void resolve(const Scene& loaded, bool is_from_file);
    void declare(Parameters& parameters);

    // What decides which parameters act, known once a scene is loaded.
    bool is_loaded = false;
    bool is_file = false;  ///< no built-in scene
    bool is_lit = false, has_points = false;
    bool has_background = true;
};

/// The parameters with which a set of views becomes a light field.
struct HOGEL_API ImportParameters {
    ViewOptions views;                         ///< without what the texts and counts that follow decide
    std::string column, projection, transfer;  ///< empty: what the set says
    std::string mirror = "none";
    Counts counts, middle;  ///< of views; none: what the set says, and all

    /// Throws Error(usage).
    ViewOptions options() const;
    /// Sets the values with which these views were imported.
    void resolve(const ImportedViews& imported);
    void declare(Parameters& parameters);
};

/// The parameters with which a light field becomes a set of views, or a film of their middle row.
struct HOGEL_API ExportParameters {
    ViewExportOptions views;  ///< without `bits`, `transfer` and `metadata`
    bool layout_given = false;
    std::size_t bits = 0;  ///< 0: as imported
    std::string transfer;  ///< empty: as imported
    double frame_rate = 24;
    bool is_film = false;

    /// Throws Error(usage).
    ViewExportOptions options() const;
    /// Sets the values that the name of the output decides: the layout unless it is given, the format of a quilt, and
    /// those of the pictures of a film. Throws Error(usage) for an unknown layout.
    void resolve(const std::filesystem::path& output);
    void declare(Parameters& parameters);
};

/// The parameters of pictures for a hologram printer.
struct HOGEL_API PrintParameters {
    PrinterImageOptions images;  ///< without `serpentine` and `metadata`
    std::string order = "serpentine";

    PrinterImageOptions options() const;
    void declare(Parameters& parameters);
};

/// The parameters of cameras whose pictures become a light field, see write_cameras().
struct HOGEL_API CamerasParameters {
    Counts hogels{defaults.hogels, defaults.hogels};
    Counts directions{9, 9};
    double size = defaults.size, distance = 0.3;  ///< metres
    Angles field_of_view{defaults.field_of_view, defaults.field_of_view};

    LightFieldGrid grid() const;
    void declare(Parameters& parameters);
};

/// The parameters of a light field of a scene.
struct HOGEL_API LightFieldParameters {
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
    SceneParameters scene;

    // What decides which parameters act, known once a light field is rendered.
    bool is_rendered = false, has_shadow_maps = false, is_lit_by_samples = false;

    /// The grid of the front. Throws Error(usage).
    LightFieldGrid grid() const;
    /// Without how the scene is turned, placed and lit. Throws Error(usage).
    LightFieldRequest request() const;
    /// With that, for load_scene(). Throws Error(usage), and what read_image() throws.
    LightFieldRequest scene_request() const;
    /// With the shading model that `auto` stands for.
    LightFieldRequest request(const Scene& loaded) const;
    /// Sets the values with which a scene at the hologram is lit, and those with which it is rendered.
    void resolve(const Scene& placed);
    void resolve(const ShadedScene& lit);

    /// Those of the scene and of the light field, without the ones that follow.
    void declare(Parameters& parameters);
    /// --hemicube, for those who use all faces.
    void declare_hemicube(Parameters& parameters);
    /// --focal-plane, --frequencies and --interpolate, for those who make light fields.
    void declare_directions(Parameters& parameters);
};

/// The parameters of a compressed light field. At most one of the targets is set, or `lossless`; otherwise
/// Defaults::sqnr is the target.
struct HOGEL_API CompressionParameters {
    std::optional<double> sqnr, pixels_per_bit, step, max_error;
    bool lossless = false;
    std::string rule = "search";     ///< of pixels_per_bit
    std::optional<double> overhead;  ///< of the other rules
    CompressionOptions compression;  ///< the coder, the transform and the steps of chrominance
    std::string table, symbols;      ///< empty: the default of CodingMethod
    std::string hemicube = "faces";
    bool no_depth = false;
    std::optional<double> depth_error;  ///< metres
    std::string tone = "none";
    double tone_decades = defaults.tone_decades;
    Counts tile;  ///< empty: the coder's preferred tile

    /// Without metadata. Throws Error(usage).
    CompressionOptions options(const LightField& light_field) const;
    /// Sets the values that act on this light field where they are not given, and what decides which act. The options()
    /// must be valid.
    void resolve(const LightField& light_field);
    void declare(Parameters& parameters);

    // What decides which parameters act, known once a light field is opened.
    bool has_sides = false, has_depth = false;
};

/// The parameters of the pattern of a modulator.
struct HOGEL_API PatternParameters {
    std::string encoding = "auto";     ///< a row of encodings(), or auto: the one that suits the fields
    PatternOptions pattern;            ///< without encoding, modulator and phase code
    std::string device;                ///< a row of modulators(), in capitals or not; empty: the following
    Counts pixels;                     ///< across and down
    double pixel_pitch = 0;            ///< metres
    std::size_t levels = 256;          ///< of a pixel
    std::string phase_code = "hogel";  ///< as parse_phase_code() takes it

    /// The modulator by name, or as described. Throws Error(usage).
    Modulator modulator() const;
    /// With the modulator and the phase code, and the encoding unless that is auto. Throws Error(usage).
    PatternOptions options() const;
    /// Encodes the fields of all wavelengths. Throws what options() and encode_pattern() throw.
    SuitablePatterns encode(const Fields& fields, const Progress& progress = {}) const;
    /// Sets the encoding with which patterns are made, and the device's name as the table writes it.
    void resolve(Encoding chosen);
    /// What the file of the patterns says of each wavelength, such as "efficiency at 532 nm", and the field_entries().
    Metadata metadata(const SuitablePatterns& encoded, const Fields& fields) const;
    void declare(Parameters& parameters);
};

/// The parameters of a scene that is lit for good.
struct HOGEL_API BakeParameters {
    BakeOptions options{.rays = defaults.bake_rays, .bounces = defaults.bake_bounces};  ///< without `seed`
    LightFieldParameters place;  ///< of which `size` and `scene` act

    void declare(Parameters& parameters);
};

struct FieldParameters;

/// The parameters of a hologram of a light field.
struct HOGEL_API HologramParameters {
    std::vector<double> wavelengths{defaults.red, defaults.green, defaults.blue};
    double pitch = defaults.pitch;
    bool pitch_given = false;        ///< otherwise a request of a light field has one that diffracts its field of view
    std::string method = "fourier";  ///< a row of hologram_methods()
    std::string phase;               ///< empty: the default of the method
    std::string average = "radiance";
    std::string basis;  ///< empty: that of the light field's coefficients, or else cdf97
    double tolerance = 0;
    double spacing = defaults.spacing;
    std::size_t planes = defaults.planes;
    double lines = 0;  ///< distance of the lines of the method lines, metres; 0: that of samples

    HologramMethod hologram_method() const;
    HologramRequest request(std::uint64_t seed, std::size_t looks) const;
    /// Of a light field of these faces.
    HologramRequest request(std::span<const LightFieldGrid> faces, std::uint64_t seed, std::size_t looks) const;
    /// A line about the pitch of that request, where it is neither given nor the default; otherwise empty.
    std::string note_about_pitch(const HologramRequest& request) const;
    /// Of a method that computes the hologram of a scene without a light field, as wide as `place` says. Throws
    /// Error(usage).
    SceneHologramRequest scene_request(std::uint64_t seed, const LightFieldParameters& place) const;

    void declare(Parameters& parameters);
    /// --pitch alone.
    Parameter& declare_pitch(Parameters& parameters);
    /// Those, and the ones of methods that compute the hologram of a scene without a light field.
    void declare_with_scene_methods(Parameters& parameters);

    // What decides which parameters act, known once a hologram is made, or a field with a pitch and wavelengths is
    // read.
    bool is_made = false, is_sampled = false;
    std::optional<HologramMethod> made_by;  ///< of a light field
    bool is_seeded = false;                 ///< whether looks differ, so that their number acts on a photograph
    bool has_spacing = false, has_planes = false;

    /// Sets the values with which a hologram of a light field with this front is made.
    void resolve(const HologramRequest& request, const LightFieldGrid& front);
    /// Sets those of a field that is opened.
    void resolve(const FieldParameters& field);
    /// Notes which parameters act on a hologram without a light field.
    void resolve(const SceneHologramMethod& method);
};

/// What FieldParameters::open() has opened, and lines that say where it took what parameters say rather than the file,
/// and which orders it found.
struct OpenedFields {
    Fields fields;
    std::vector<std::string> notes;
};

/// The parameters of a field that another program wrote, and of the image that is reconstructed of any hologram.
struct HOGEL_API FieldParameters {
    std::string code_option = "--phase-code";  ///< otherwise where a command has another parameter of this name
    double pitch = 0;                          ///< metres
    std::vector<double> wavelengths;           ///< metres
    std::string values, phase_code, imaginary, phases, zero = "median", variable;
    std::optional<PhaseCode> own_code;  ///< in place of the one that `phase_code` names
    bool conjugate = false;
    std::string order, reconstruct = "none";
    double aperture = 0;  ///< cycles per sample
    std::optional<Vec3> reference_source;
    std::optional<double> focal;  ///< metres

    bool is_opened = false;  ///< whether a field of another program is open, so that its parameters act

    /// The parameters of what the file holds.
    /// @param sampling  whether also --pitch and --wavelength, which otherwise the command has, and sets here
    /// @param brief     without what the help of `photo` explains
    void declare(Parameters& parameters, bool sampling = true, bool brief = false);
    /// Those of a lens or a reference wave between the hologram and its image.
    void declare_reconstruction(Parameters& parameters);

    /// Whether a name is that of another program's field: an array, a pattern, or a picture that parameters describe.
    bool is_external(const std::string& name) const;
    /// Whether a file is a picture that describes its field, as patterns do, and no parameter describes it.
    bool is_pattern(const std::string& name) const;
    /// Throws Error(usage) for a picture whose numbers neither it nor a parameter describes.
    void require_described(const std::string& name) const;
    /// What the parameters say of a file, without its sampling. Throws Error(usage).
    ExternalField external_field() const;

    /// Opens a hologram or another program's field, and sets the values that the file says.
    /// @param table  of the command, with --pitch and --wavelength
    /// Throws Error(usage) where neither says the sampling, and for a hologram of which parameters say what only it can
    /// say; Error(bad_input) for anything else, and what open_hologram() and open_external_field() throw.
    OpenedFields open(const std::string& name, const Parameters& table);
    /// Likewise, then cuts out the order of the object and makes the image behind a lens.
    OpenedFields open_and_reconstruct(const std::string& name, const Parameters& table, const Progress& progress = {});
};

/// The parameters of a plane to which fields are propagated.
struct HOGEL_API PropagateParameters {
    double distance = 0;                ///< metres
    double output_pitch = 0;            ///< metres; 0: that of the field
    Counts output_samples;              ///< none: as many as the field has
    double offset_x = 0, offset_y = 0;  ///< metres from the middle of the field
    double max_error = PropagateOptions().max_error;
    std::string display = "intensity";  ///< what a picture of the output shows

    bool is_picture = false;  ///< whether there is one, so that `display` acts

    void declare(Parameters& parameters);
    /// With the samples of the output for a field with these.
    PropagateOptions options(const Grid& field) const;
    /// Sets the values of the output.
    void resolve(const Grid& output);
};

/// The parameters of a camera, and of its way from the first picture of a film to the last.
struct HOGEL_API CameraParameters {
    Vec3 eye{0, 0, defaults.eye_distance}, gaze;
    double focus = 0;
    Angles focus_tilt;
    double pupil = defaults.pupil;
    std::optional<double> f_number;  ///< in place of the pupil, with the focal length
    double focal_length = defaults.focal_length;
    double angle_of_view = 0;                   ///< horizontal; 0: the angle that frames the hologram
    Counts resolution{defaults.resolution, 0};  ///< rows 0: as many as the hologram's shape takes
    std::optional<Vec3> last_eye;
    std::optional<double> last_focus;
    std::size_t frames = 1;
    double frame_rate = defaults.frame_rate;
    bool is_film = false;  ///< whether the frame rate acts

    /// The camera of each picture of a hologram of this size, metres. Throws Error(usage).
    std::vector<Camera> cameras(double width, double height) const;
    /// Those of one camera.
    void declare(Parameters& parameters);
    /// --to-eye, --to-focus, --frames and --frame-rate.
    void declare_motion(Parameters& parameters);
};

/// What a photograph is computed from.
enum class PhotographSource {
    rays,     ///< of a light field
    hogels,   ///< of a hologram that is computed when it is read
    samples,  ///< of a hologram in a file or in memory
};

/// The parameters of the camera that photographs waves.
struct HOGEL_API WaveCameraParameters {
    /// auto, eye, narrow or full; in the words of the library hogel-spectra, samples or plane-waves.
    std::string camera = "auto";
    std::string looks = {};  ///< a number, or expected: the mean of infinitely many; empty: enough_looks()
    bool preview = false;
    double film_distance = 0;  ///< of a thin lens, metres; 0: a perfect lens
    std::string diffuser = "none";

    bool is_expected() const { return looks == "expected"; }
    /// HologramRequest::looks: 0 if empty, 1 for expected. Throws Error(usage).
    std::size_t number_of_looks() const;
    CameraModel model() const;

    // What decides which parameters act.
    PhotographSource source = PhotographSource::hogels;
    bool has_looks = true;  ///< whether they differ

    /// Notes what is photographed. Throws Error(usage) for parameters that exclude each other or that it excludes.
    void resolve(PhotographSource photographed);
    /// Sets the camera to the one that is chosen for holograms of a light field with these faces, and returns the
    /// reason. Throws Error(usage) where the one that is asked for cannot photograph them.
    std::string resolve(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                        std::span<const Camera> cameras);

    /// --camera, with or without the one of plane waves.
    Parameter& declare_camera(Parameters& parameters, bool with_plane_waves);
    /// --looks, with other names and help before that of `expected`.
    Parameter& declare_looks(Parameters& parameters, const std::string& names, const std::string& help);
    /// --camera, --preview, --film-distance and --diffuser.
    void declare(Parameters& parameters);

  private:
    std::string name() const;
};

/// The parameters of a photograph by rays or by waves.
struct HOGEL_API PhotoParameters {
    CameraParameters view;
    WaveCameraParameters waves{.looks = std::to_string(defaults.looks)};
    std::size_t pupil_samples = defaults.pupil_samples;  ///< of a photograph by rays
    std::string exposure = "auto";
    std::string display = "intensity";
    bool geometric = false, wave = false;  ///< neither: by rays of a light field, by waves of a scene

    bool is_linear = false;  ///< whether the picture is stored without an exposure

    /// Notes what is photographed. Throws Error(usage) for parameters that exclude each other or that it excludes.
    void resolve(PhotographSource photographed);
    void declare(Parameters& parameters);
};

/// The parameters of make().
struct HOGEL_API MakeParameters {
    LightFieldParameters render;
    HologramParameters hologram;
    double eye_distance = defaults.eye_distance;
    double pupil = defaults.pupil;
    WaveCameraParameters waves;
    std::size_t resolution = defaults.resolution;
    std::size_t pupil_samples = defaults.pupil_samples;

    /// What is made, which decides which parameters act. The report lists those of all.
    enum class Output { light_field, hologram, photographs, expected_photographs, ray_photographs, report };
    Output made = Output::report;
    bool is_one_of(const std::vector<Output>& outputs) const;

    MakeRequest request(std::uint64_t seed) const;
    /// @param with_plane_waves  whether --camera may be the one of plane waves
    void declare(Parameters& parameters, bool with_plane_waves = false);
};

/// The parameters of `hogel view`.
struct HOGEL_API ViewerParameters {
    std::string input;
    std::string host = "127.0.0.1";
    std::uint64_t port = 0;  ///< 0: one that is free
    std::string token;       ///< empty: none, on this machine alone
    bool no_browser = false;
    double memory = 4;  ///< GB for the samples of the light field
    std::size_t looks = defaults.looks;
    std::size_t layers = 0;  ///< of a .hgl stream; 0: all
    std::string original;    ///< a light field beside which errors are shown; empty: the whole stream
    LightFieldParameters render;
    HologramParameters hologram;
    FieldParameters field;

    void declare(Parameters& parameters);
    /// What there is to open: the input, or in a folder that `hogel make` wrote its light field. Throws Error(usage)
    /// and Error(bad_input) for what cannot be viewed, and Error(usage) for a host or token that is not allowed.
    std::string viewable() const;
};

}  // namespace hogel
