// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/bench.h"
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
#include "hogel/reconstruct.h"
#include "hogel/scene_hologram.h"

namespace hogel {

// Options that the command line, Python and the viewer share. Each struct has the values of one group. declare() adds a
// row per option to a table, which the struct must outlive. A function of the struct returns the library's request.
// resolve() stores the values selected by the work, and decides which options have an effect; files store these.

/// Parses a directional light, "X,Y,Z:COLOUR:STRENGTH". X,Y,Z is the direction from the scene to the light, of any
/// length; Light::direction is the opposite, of unit length. COLOUR (default: white) times STRENGTH (default: 2.2) is
/// the irradiance of a surface that faces the light. Throws Error(usage).
HOGEL_API Light parse_light(const std::string& text);
/// Parses the light source of a bench: "laser", "led:520nm,30nm,0.5mm" (mean wavelength, width at half maximum,
/// diameter) or "sources:16,2mm" (points, diameter). Throws Error(usage).
HOGEL_API LightSource parse_light_source(const std::string& text);
/// Returns the text of a light for parse_light(). Empty for a point light, a cone, or a light without shadows.
HOGEL_API std::string light_text(const Light& light);

/// Pose, colours and lights of a scene.
struct HOGEL_API SceneParameters {
    ScenePose pose;  ///< except `lights` and `texture`
    std::vector<std::string> lights;
    std::string texture;    ///< file name of a picture
    double point_size = 1;  ///< 1: discs that just close the surface
    std::string depth_map;  ///< file name of the depth map of a picture
    std::string depth_values = "auto";
    std::optional<double> near, far;  ///< depths of that map, metres

    /// Returns the options of import_scene().
    ImportOptions import_options() const;
    /// Returns the pose with its lights and picture. Throws Error(usage) for a malformed light, and as read_image().
    ScenePose complete_pose() const;
    /// Stores the facts of the loaded scene.
    /// @param is_from_file  false for a built-in scene
    void resolve(const Scene& loaded, bool is_from_file);
    void declare(Parameters& parameters);

    // Set by resolve().
    bool is_loaded = false;
    bool is_file = false;  ///< a file whose depth the front places; false: a built-in scene or a picture at its depths
    bool is_lit = false, has_points = false, has_depth_map = false;
    bool has_background = true;
};

/// Import of a set of views as a light field.
struct HOGEL_API ImportParameters {
    ViewImportOptions views;                   ///< except members that options() makes of the following values
    std::string column, projection, transfer;  ///< empty: as recognised
    std::string mirror = "none";
    Counts counts;  ///< views across and down; 0: as recognised
    Counts middle;  ///< views to import, in the middle of the set; 0: all

    /// Returns the options of import_views(). Throws Error(usage).
    ViewImportOptions options() const;
    /// Stores the recognised layout, transfer curve and width.
    void resolve(const ImportedViews& imported);
    void declare(Parameters& parameters);
};

/// Parses an exposure: 0 for "auto". Throws Error(usage) for other texts that are not positive numbers.
HOGEL_API double parse_exposure(const std::string& text);

struct LightFieldParameters;

/// Export of a light field or a scene as a set of views, or as a film of the middle row of views.
struct HOGEL_API ExportParameters {
    ViewExportOptions views;  ///< except `bits`, `transfer`, `exposure`, `display` and `metadata`
    bool layout_given = false;
    std::size_t bits = 0;    ///< 0: as imported
    std::string transfer;    ///< empty: as imported
    std::string exposure;    ///< for parse_exposure(); empty: auto for quilts and films, otherwise 1
    std::string device;      ///< name of a row of quilt_displays(); empty: tiles have a pixel for each hogel
    double frame_rate = 24;  ///< frames per second
    bool is_film = false;

    bool is_quilt() const { return views.layout == "quilt"; }
    /// Returns the options of export_views(). Throws Error(usage).
    ViewExportOptions options() const;
    /// Derives values from the name of the output: the layout unless it is given, the picture format of a quilt, and
    /// the pictures of a film. Stores the device's name as quilt_displays() spells it. Throws Error(usage) for an
    /// unknown layout, and for a device with another layout, and as find_quilt_display() does.
    void resolve(const std::filesystem::path& output);
    /// Sets the grid of a scene's light field for a quilt, after resolve(): hogels, directions, field of view and focal
    /// plane. Without a device, selects the first display whose tiles are those of the name. Throws Error(usage) if
    /// `given` has other numbers of hogels or directions.
    void set_cameras(LightFieldParameters& scene, const std::filesystem::path& output, const Parameters& given);
    /// Returns a line about the depths at which a quilt stays sharp, and about options if the placed scene exceeds
    /// them. Returns an empty text for other layouts.
    std::string note_about_depth(const Scene& placed, const LightFieldParameters& scene) const;
    void declare(Parameters& parameters);
};

/// Pictures for a hologram printer.
struct HOGEL_API PrintParameters {
    PrinterImageOptions images;  ///< `rows`, `planes` and `transpose` only; options() makes the others of these:
    std::string order = "serpentine", mirror = "none", transfer = "srgb", exposure = "1", dose = "1,1,1";
    std::size_t bits = 8;
    std::string mask;   ///< "circle", or file name of a picture; empty: none
    std::string table;  ///< file name; empty: none

    /// Returns the options of write_printer_images(). Reads the files of mask and table. Throws Error(usage), and as
    /// read_raw_pixels() does.
    PrinterImageOptions options() const;
    void declare(Parameters& parameters);
};

/// The camera array of write_cameras().
struct HOGEL_API CamerasParameters {
    Counts hogels{defaults.hogels, defaults.hogels};
    Counts directions{9, 9};
    double size = defaults.size, distance = 0.3;  ///< metres
    Angles field_of_view{defaults.field_of_view, defaults.field_of_view};

    LightFieldGrid grid() const;
    void declare(Parameters& parameters);
};

/// Rendering of a scene into a light field.
struct HOGEL_API LightFieldParameters {
    std::string algorithm{defaults.renderer};
    std::string shading{defaults.shading};
    std::size_t shadow_map = defaults.shadow_map;
    double cache_spacing = defaults.cache_spacing;
    Counts hogels{defaults.hogels, defaults.hogels};
    Counts directions{defaults.directions, defaults.directions};
    Counts samples{1, 1};         ///< per ray: along a hogel's side, along a side of a direction's cell
    double size = defaults.size;  ///< width of the hologram, metres
    Angles field_of_view{defaults.field_of_view, defaults.field_of_view};
    bool field_of_view_given = false;  ///< otherwise a hemicube spans 180 degrees
    bool hogels_given = false, directions_given = false, size_given = false;  ///< otherwise fit() may set them
    Angles toward;
    bool hemicube = false;
    double focal_plane = 0;          ///< depth of a fixed focal plane, metres
    bool focal_plane_given = false;  ///< otherwise hogels have the same directions
    double frequencies = 0;          ///< metres; directions on the frequency grid of this wavelength; 0: perspective
    bool as_is = false;
    std::size_t interpolate = 0;     ///< side of the regions of hogels, with `interpolate_given`
    bool interpolate_given = false;  ///< otherwise every sample is shaded by itself
    bool fronts_only = false;        ///< whether back faces are culled
    double front = defaults.front;
    SceneParameters scene;

    // Set by resolve().
    bool is_rendered = false, has_shadow_maps = false, is_lit_by_samples = false;

    /// Returns the grid of the front face. Throws Error(usage).
    LightFieldGrid grid() const;
    /// Returns the request without the pose of the scene. Throws Error(usage).
    LightFieldRequest request() const;
    /// Returns the request with the pose, for load_scene(). Throws Error(usage), and as read_image() does.
    LightFieldRequest scene_request() const;
    /// Returns the request with the shading model that `auto` selects for a scene.
    LightFieldRequest request(const Scene& loaded) const;
    /// Stores the shading of a placed scene, and the facts of its lighting.
    void resolve(const Scene& placed);
    void resolve(const ShadedScene& lit);

    /// Declares the options of the scene and of the light field, except those of the next two functions.
    void declare(Parameters& parameters);
    /// Declares --hemicube, for commands that use all faces.
    void declare_hemicube(Parameters& parameters);
    /// Declares --focal-plane, for commands that use a single face.
    Parameter& declare_focal_plane(Parameters& parameters);
    /// Declares --focal-plane, --frequencies and --interpolate, for commands that write light fields.
    void declare_directions(Parameters& parameters);
};

/// Compression of a light field. At most one target is set: an SQNR (dB), pixels per bit, a step (radiance), a greatest
/// error (radiance), or `lossless`. Without one the target is Defaults::sqnr.
struct HOGEL_API CompressionParameters {
    std::optional<double> sqnr, pixels_per_bit, step, max_error;
    bool lossless = false;
    std::string rule = "search";     ///< how pixels_per_bit finds the step
    std::optional<double> overhead;  ///< bits per nonzero coefficient, for rules other than search
    CompressionOptions compression;  ///< the coder, the transform and the steps of chrominance
    std::string table, symbols;      ///< empty: the default of CodingMethod
    std::string hemicube = "faces";
    bool no_depth = false;
    std::optional<double> depth_error;  ///< metres
    std::string tone = "none";
    double tone_decades = defaults.tone_decades;
    Counts tile;  ///< hogels; 0: the coder's preferred tile

    /// Returns the options without metadata. Throws Error(usage).
    CompressionOptions options(const LightField& light_field) const;
    /// Stores the defaults that the coder selects. options() must not throw.
    void resolve(const LightField& light_field);
    void declare(Parameters& parameters);

    // Set by resolve().
    bool has_sides = false, has_depth = false;
};

/// The pattern of a spatial light modulator.
struct HOGEL_API PatternParameters {
    std::string encoding = "auto";  ///< name of a row of encodings(), or auto: selected for the fields
    PatternOptions pattern;         ///< except encoding, modulator and phase code
    std::string device;             ///< for find_modulator(); empty: the next three values
    Counts pixels;                  ///< across and down
    double pixel_pitch = 0;         ///< metres
    std::size_t levels = 256;       ///< per pixel
    std::string phase_code;         ///< for parse_phase_code(); empty: that of the device, or hogel
    std::size_t frames = 1;         ///< patterns shown in turn, for the encoding supervised
    double distance = 0;            ///< of the hologram plane in front of the modulator, metres
    std::string lut, correction;    ///< files of a level table and a wavefront correction; empty: those of the device
    std::string flip;               ///< none, horizontal, vertical or both; empty: that of the device
    double lens = 0;                ///< focal length, metres; 0: none
    std::string blaze;              ///< "FX,FY": cycles a pixel to the right and upwards; empty: none

    /// Returns the named or described modulator. Throws Error(usage), and as find_modulator() does.
    Modulator modulator() const;
    /// Returns the phase code that is used.
    std::string code() const;
    /// Reads what is added for the panel. Throws Error(usage) and Error(bad_input).
    PanelOptions panel() const;
    /// Returns hogel::panel_levels() of each pattern.
    std::vector<Array<std::uint16_t, 2>> panel_levels(const SuitablePatterns& encoded, const Fields& fields) const;
    /// Returns notes_about() the modulator and the wavelengths of the fields.
    std::vector<std::string> notes(const Fields& fields) const;
    /// Returns the options with modulator and phase code, and with the encoding unless it is auto. Throws Error(usage).
    PatternOptions options() const;
    /// Returns the fields at the modulator: holograms, propagated back by `distance`. Throws as propagate() does.
    Fields at_modulator(const Fields& fields, const Progress& progress = {}) const;
    /// Encodes the field of each wavelength. Throws as options() and encode_pattern() do.
    SuitablePatterns encode(const Fields& fields, const Progress& progress = {}) const;
    /// Returns the number of looks that encode() needs: one for each of the patterns that are shown in turn.
    std::size_t looks() const;
    /// Encodes holograms of a light field with looks() looks; supervised needs the light field. Throws as options(),
    /// encode_pattern() and encode_supervised() do.
    SuitablePatterns encode(const Fields& holograms, const LightField& light_field, const HologramRequest& request,
                            const Progress& progress = {}) const;
    /// Stores the selected encoding, the device's name as modulators() spells it, and what its profile sets.
    void resolve(Encoding chosen);
    /// Returns metadata of a pattern file: results of each wavelength, such as "efficiency at 532 nm", and
    /// field_entries().
    Metadata metadata(const SuitablePatterns& encoded, const Fields& fields) const;
    void declare(Parameters& parameters);
};

/// Baking of the lighting into the vertices of a scene.
struct HOGEL_API BakeParameters {
    BakeOptions options{.rays = defaults.bake_rays, .bounces = defaults.bake_bounces};  ///< except `seed`
    LightFieldParameters place;  ///< only `size` and `scene` have an effect

    void declare(Parameters& parameters);
};

struct FieldParameters;

/// A hologram of a light field, or of a scene.
struct HOGEL_API HologramParameters {
    std::vector<double> wavelengths{defaults.red, defaults.green, defaults.blue};  ///< metres
    double pitch = defaults.pitch;                                                 ///< of the samples, metres
    bool pitch_given = false;        ///< false: request(faces, …) may select a smaller pitch
    std::string method = "fourier";  ///< name of a row of hologram_methods()
    bool method_given = false;       ///< false: a command may select method and phase
    std::string phase;               ///< empty: the default of the method
    std::string average = "radiance";
    std::string basis;                     ///< empty: that of the light field's coefficients, else cdf97
    double tolerance = 0;                  ///< fraction of a hogel's amplitude
    double spacing = defaults.spacing;     ///< of points on surfaces, metres
    std::size_t planes = defaults.planes;  ///< depth planes
    double lines = 0;  ///< distance of lines, metres, for the method lines; 0: the pitch of the samples

    /// Fits the geometry of a scene's hologram to the pixels of a modulator, where options do not say otherwise: the
    /// pitch of the samples, hogels of whole pixels that fill the panel, and a field of view that is a part of the
    /// shortest wavelength's band.
    /// @param smooth  true: for smooth phases, which double-phase encoding shows: hogels of 2 pixels, 5x5 directions, a
    ///                quarter of the band. false: for random phases: 4 pixels, 9x9 directions, 7/8 of the band
    void fit(const Modulator& modulator, LightFieldParameters& light_field, bool smooth);

    /// Returns a light field at the scale that suits a modulator: hogels of whole pixels, as large as the panel allows,
    /// and directions within its band (7/8 of it), otherwise within the part of it that fit() gives a scene. Returns a
    /// light field that suits already unchanged, and one of more hogels than pixels.
    LightField fitted(const LightField& light_field, const Modulator& modulator, bool smooth) const;

    HologramMethod hologram_method() const;
    HologramRequest request(std::uint64_t seed, std::size_t looks) const;
    /// Returns the request for a light field with these faces. Unless the pitch is given, it is diffracting_pitch().
    HologramRequest request(std::span<const LightFieldGrid> faces, std::uint64_t seed, std::size_t looks) const;
    /// Returns a line about a selected pitch; empty if the request has the given or the default pitch.
    std::string note_about_pitch(const HologramRequest& request) const;
    /// Returns that line, or one about a given pitch that changes by more than 0.1 % so that the hogels of this front
    /// face hold whole samples. It names a size that keeps the pitch.
    std::string note_about_pitch(const HologramRequest& request, const LightFieldGrid& front) const;
    /// Returns the request of a method without a light field. The hologram has the size of `place`. Throws
    /// Error(usage).
    SceneHologramRequest scene_request(std::uint64_t seed, const LightFieldParameters& place) const;

    void declare(Parameters& parameters);
    /// Declares only --pitch.
    Parameter& declare_pitch(Parameters& parameters);
    /// Declares the options of declare(), and those of methods without a light field.
    void declare_with_scene_methods(Parameters& parameters);

    // Set by resolve().
    bool is_made = false, is_sampled = false;
    std::optional<HologramMethod> made_by;  ///< empty: a method without a light field
    bool is_seeded = false;                 ///< whether the method draws random phases
    bool has_spacing = false, has_planes = false;

    /// Stores the values of a hologram of a light field with this front face.
    void resolve(const HologramRequest& request, const LightFieldGrid& front);
    /// Stores pitch and wavelengths of an opened field.
    void resolve(const FieldParameters& field);
    void resolve(const SceneHologramMethod& method);
};

/// Calls require_holograms(). Errors name options of the light field only if it is `rendered`, not read from a file.
HOGEL_API void check_holograms(std::span<const LightFieldGrid> faces, const HologramRequest& request, bool rendered,
                               std::span<const Camera> cameras = {});

/// The result of FieldParameters::open(). Notes list overridden values and the selected order.
struct OpenedFields {
    Fields fields;
    std::vector<std::string> notes;
};

/// A field of another program, and reconstruction of an image from any hologram.
struct HOGEL_API FieldParameters {
    std::string code_option = "--phase-code";  ///< option name, if --phase-code has another meaning
    double pitch = 0;                          ///< metres
    std::vector<double> wavelengths;           ///< metres
    std::string values, phase_code, imaginary, phases, zero = "median", variable;
    std::optional<PhaseCode> own_code;  ///< replaces `phase_code`
    bool conjugate = false;
    std::string order, reconstruct = "none";
    double aperture = 0;  ///< cycles per sample
    std::optional<Vec3> reference_source;
    std::optional<double> focal;  ///< metres

    bool is_reflectance = false;  ///< for ExternalField::reflectance
    double device_pitch = 0;      ///< pitch of a file that does not contain it, metres; 0: it must be given

    bool is_opened = false;  ///< whether a field of another program is open; set by open()

    /// Declares the options that describe the file.
    /// @param sampling  whether to declare --pitch and --wavelength; false: the command declares and sets them
    /// @param brief     short help, for commands that refer to `photo`
    void declare(Parameters& parameters, bool sampling = true, bool brief = false);
    /// Declares the options of the diffraction order, the reference wave and the lens.
    /// @param with_bench  whether the command has a bench, whose lens --focal is
    void declare_reconstruction(Parameters& parameters, bool with_bench = false);

    /// Returns whether a file is a field of another program: an array, a pattern, or a picture that options describe.
    bool is_external(const std::string& name) const;
    /// Returns whether a file is a picture that describes its own field, and no option describes it.
    bool is_pattern(const std::string& name) const;
    /// Throws Error(usage) for a picture that neither its metadata nor an option describes.
    void require_described(const std::string& name) const;
    /// Returns the description of the file, without its sampling. Throws Error(usage).
    ExternalField external_field() const;

    /// Returns the order and its aperture. Throws Error(usage).
    OrderSelection selection() const;

    /// Opens a hologram or a field of another program, and stores the values in the file. Throws Error(usage) if
    /// neither the file nor an option gives the sampling, and if an option describes a hologram; Error(bad_input) for
    /// other files; and as open_hologram() and open_external_field() do.
    /// @param table  options of the command, with --pitch and --wavelength
    OpenedFields open(const std::string& name, const Parameters& table);
    /// Opens the fields, selects the diffraction order, and computes the image behind the lens.
    OpenedFields open_and_reconstruct(const std::string& name, const Parameters& table, const Progress& progress = {});
};

/// Propagation of a field to a parallel plane.
struct HOGEL_API PropagateParameters {
    double distance = 0;                ///< metres
    double output_pitch = 0;            ///< metres; 0: that of the field
    Counts output_samples;              ///< 0: as many as the field has
    double offset_x = 0, offset_y = 0;  ///< metres from the centre of the field
    double max_error = PropagateOptions().max_error;
    std::string display = "intensity";  ///< quantity that a picture shows

    bool is_picture = false;  ///< whether the output is a picture

    void declare(Parameters& parameters);
    /// Returns the options for a field on this grid.
    PropagateOptions options(const Grid& field) const;
    /// Stores pitch and number of samples of the output.
    void resolve(const Grid& output);
};

/// A camera, and its motion from the first to the last picture of a film. Lengths are in metres, angles in radians.
struct HOGEL_API CameraParameters {
    Vec3 eye{0, 0, defaults.eye_distance}, gaze;
    double focus = 0;  ///< depth
    Angles focus_tilt;
    double pupil = defaults.pupil;
    std::optional<double> f_number;  ///< replaces the pupil: focal_length / f_number
    double focal_length = defaults.focal_length;
    double angle_of_view = 0;                   ///< horizontal; 0: the angle that frames the hologram
    Counts resolution{defaults.resolution, 0};  ///< rows 0: by the hologram's aspect ratio
    std::optional<Vec3> last_eye;
    std::optional<double> last_focus;
    std::size_t frames = 1;
    double frame_rate = defaults.frame_rate;  ///< frames per second
    bool is_film = false;                     ///< whether the output is a film
    bool is_bench = false;                    ///< whether only the focus has an effect, as on a bench

    /// Returns the camera of each picture of a hologram of this size (metres). Throws Error(usage).
    std::vector<Camera> cameras(double width, double height) const;
    /// Declares the options of one camera.
    void declare(Parameters& parameters);
    /// Declares --to-eye, --to-focus, --frames and --frame-rate.
    void declare_motion(Parameters& parameters);
};

/// Source of a photograph.
enum class PhotographSource {
    rays,     ///< rays of a light field
    hogels,   ///< hogels of a hologram that is computed on demand
    samples,  ///< samples of a hologram in a file or in memory
};

/// The camera of photographs by wave optics.
struct HOGEL_API WaveCameraParameters {
    /// auto, eye (hogel-spectra), narrow (samples) or full (plane-waves).
    std::string camera = "auto";
    std::string looks = {};  ///< number of looks; empty: enough_looks(); "expected": as speckle = "none"
    /// averaged: over the looks; none: speckle-free, the mean over infinitely many looks.
    std::string speckle = "averaged";
    bool preview = false;
    double film_distance = 0;  ///< from a thin lens, metres; 0: a perfect lens
    std::string diffuser = "none";

    bool is_speckle_free() const { return speckle == "none" || looks == "expected"; }
    /// Returns HologramRequest::looks: 0 if empty, 1 if speckle-free. Throws Error(usage).
    std::size_t number_of_looks() const;
    CameraModel model() const;

    PhotographSource source = PhotographSource::hogels;  ///< set by resolve()
    bool has_looks = true;                               ///< whether looks differ

    /// Throws Error(usage) for options that the source or other options exclude.
    void resolve(PhotographSource photographed);
    /// Stores the camera selected for holograms of a light field with these faces, and returns the reason. Throws
    /// Error(usage) if the given camera cannot photograph them.
    std::string resolve(std::span<const LightFieldGrid> faces, const HologramRequest& request,
                        std::span<const Camera> cameras);

    /// Declares only --camera.
    /// @param with_plane_waves  whether to include the value full
    Parameter& declare_camera(Parameters& parameters, bool with_plane_waves);
    /// Declares only --looks.
    /// @param names  "--looks", with aliases
    /// @param help   its first line
    Parameter& declare_looks(Parameters& parameters, const std::string& names, const std::string& help);
    /// Declares only --speckle.
    Parameter& declare_speckle(Parameters& parameters);
    /// Declares --camera, --preview, --film-distance and --diffuser.
    void declare(Parameters& parameters);

  private:
    std::string name() const;
    void read_looks();
};

/// The optical bench of photographs of patterns: its lens is FieldParameters::focal without a reconstruction.
struct HOGEL_API BenchParameters {
    std::string device;                 ///< modulator of a file that does not describe it; for find_modulator()
    std::string source = "laser";       ///< for parse_light_source()
    std::optional<double> fill_factor;  ///< share of a pixel's area that modulates; default: of the device, or 1
    double zero_order_stop = 0;         ///< radius, cycles per pixel; 0: none

    bool is_used = false;  ///< set by resolve()

    /// Sets what a picture of levels needs to be opened, from the profile of the device.
    void describe(const std::string& input, FieldParameters& field) const;
    /// Decides whether the photograph is one on the bench. Throws Error(usage) for an input that is no pattern, and for
    /// options of the bench without its lens, or of other cameras with it.
    void resolve(const std::string& input, FieldParameters& field, const Parameters& table);
    /// Returns the bench for an opened pattern. Without --order and --aperture the aperture is that of the pattern's
    /// file, or else the largest. Throws Error(usage).
    Bench bench(const std::string& input, const FieldSource& pattern, const FieldParameters& field, double focus) const;
    /// Returns the power of the light on a pattern's modulator that its file states, for a wavelength in metres;
    /// else 1.
    double power(const std::string& input, double wavelength) const;
    /// Returns notes_about() the device. Throws Error(usage) if the patterns do not have its pixels.
    std::vector<std::string> notes(const std::string& input, const Fields& patterns) const;
    void declare(Parameters& parameters);
};

/// A photograph by geometric optics or by wave optics, or on a bench.
struct HOGEL_API PhotoParameters {
    CameraParameters view;
    WaveCameraParameters waves{.looks = std::to_string(defaults.looks)};
    BenchParameters bench;
    std::size_t pupil_samples = defaults.pupil_samples;  ///< points of the pupil, by geometric optics
    std::string exposure = "auto";
    std::string display = "intensity";
    bool geometric = false, wave = false;  ///< neither: geometric for a light field, wave for a scene

    bool is_linear = false;  ///< whether the file stores linear values, without an exposure

    /// Throws Error(usage) for options that the source or other options exclude.
    void resolve(PhotographSource photographed);
    void declare(Parameters& parameters);
};

/// The request of make().
struct HOGEL_API MakeParameters {
    LightFieldParameters render;
    HologramParameters hologram;
    std::string device;  ///< name of the modulator whose pixels the hologram fits; empty: none
    double eye_distance = defaults.eye_distance;
    double pupil = defaults.pupil;
    WaveCameraParameters waves;
    std::size_t resolution = defaults.resolution;
    std::size_t pupil_samples = defaults.pupil_samples;

    /// The output that selects the options with an effect; `report` selects the options of all outputs.
    enum class Output { light_field, hologram, photographs, speckle_free_photographs, ray_photographs, report };
    Output made = Output::report;
    bool is_one_of(const std::vector<Output>& outputs) const;

    /// Fits the hologram's geometry to `device`, if it is named. Throws as find_modulator() does.
    void fit();
    MakeRequest request(std::uint64_t seed) const;
    /// @param with_plane_waves  whether to include the value full of --camera
    void declare(Parameters& parameters, bool with_plane_waves = false);
};

/// The viewer.
struct HOGEL_API ViewerParameters {
    std::string input;
    std::string host = "127.0.0.1";
    std::uint64_t port = 0;  ///< 0: a free port
    std::string token;       ///< empty: no token, for a loopback address
    bool no_browser = false;
    double memory = 4;  ///< GB for the samples of the light field
    std::size_t looks = defaults.looks;
    std::size_t layers = 0;  ///< decoded layers of a .hgl stream; 0: all
    std::string original;    ///< reference light field of displayed errors; empty: the complete stream
    LightFieldParameters render;
    HologramParameters hologram;
    FieldParameters field;

    void declare(Parameters& parameters);
    /// Returns the file or scene to open: the input, or the light field in a folder of `hogel make`. Throws
    /// Error(usage) and Error(bad_input) for other inputs, and Error(usage) for a host or token that is not allowed.
    std::string viewable() const;
};

}  // namespace hogel
