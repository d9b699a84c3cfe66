// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "camera_options.h"
#include "commands.h"
#include "fields.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/team.h"
#include "inputs.h"
#include "movie.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    LightFieldParameters render;
    HologramParameters hologram;
    FieldOptions field;
    CameraOptions view;
    std::string looks = std::to_string(defaults.looks);
    std::size_t pupil_samples = defaults.pupil_samples;
    std::string exposure = "auto", display = "intensity";
    std::string camera = "auto";
    std::string diffuser = "none";
    bool geometric = false, wave = false, preview = false, resume = false;

    double film_distance = 0;

    // What decides which options act.
    InputKind kind = InputKind::scene;
    bool is_expected() const { return parse_looks(looks).expected; }
    // EXR files hold linear values, which no exposure multiplies.
    bool is_exposed() const { return display == "intensity" && std::filesystem::path(output).extension() != ".exr"; }

    // The full camera's scratch files are in the picture's folder.
    CameraModel camera_model() const {
        if (camera == "full")
            return PlaneWaveCamera{
                {.memory = ScratchOptions().memory, .folder = std::filesystem::absolute(output).parent_path()},
                film_distance};
        CameraModel model = cli::camera_model(camera, parse_looks(looks).expected);
        if (auto* const band = std::get_if<BandCamera>(&model)) {
            band->vertical_diffuser = has_diffuser();
            band->preview = preview;
        }
        return model;
    }
    bool has_diffuser() const { return diffuser == "vertical"; }
};

double parse_exposure(const std::string& text) {
    const std::optional<double> exposure = parse_number(text);
    if (!exposure || !(*exposure > 0 && *exposure < 1e12))
        throw Error(ErrorCode::usage, fmt::format("--exposure: '{}' is neither auto nor a positive number", text));
    return *exposure;
}

// Photographs the intensity of the light or its phase.
std::vector<Image> develop(Stage& stage, const Fields& fields, std::span<const Camera> cameras,
                           const Options& options) {
    if (options.display != "phase")
        return with_parameter(
            "camera", [&] { return photograph_colours(fields, cameras, options.camera_model(), stage.progress()); });
    if (fields.size() != 1)
        throw Error(ErrorCode::usage,
                    fmt::format("--display phase: a phase is that of one wavelength, but there are {}", fields.size()));
    std::vector<Image> pictures;
    for (const auto& wave : waves_in_focus(*fields.front(), 0, cameras,
                                           std::get<PlaneWaveCamera>(options.camera_model()), stage.progress()))
        pictures.push_back(picture_of(wave, FieldQuantity::phase));
    return pictures;
}

std::vector<Image> photographs_of_hologram(Options& options, const Session& session) {
    const Fields fields = open_and_reconstruct(session, options.input, options.field, options.hologram.pitch,
                                               options.hologram.wavelengths);
    options.hologram.is_sampled = options.field.is_external;
    if (fields.size() != 1 && fields.size() != 3)
        throw Error(ErrorCode::bad_input, fmt::format("{}: has {} wavelengths; a photograph takes one or three",
                                                      options.input, fields.size()));
    const Grid& plane = fields.front()->grid().plane;
    const std::vector<Camera> cameras = make_cameras(options.view, plane.size_x(), plane.size_y());
    const CameraModel model = options.camera_model();
    if (options.camera == "auto") options.camera = "narrow";
    with_renamed_parameters({{"pitch", ""}}, [&] {  // it is that of the field
        std::vector<FieldGrid> grids;
        for (const auto& field : fields) {
            for (const Camera& camera : cameras) require_light_towards(field->grid(), camera, options.has_diffuser());
            grids.push_back(field->grid());
        }
        if (std::holds_alternative<BandCamera>(model))
            state_plan(session, plan_photographs(grids, fields.front()->looks(), cameras, model),
                       "photographing the hologram");
    });
    Stage stage(session, "wave photograph");
    std::vector<Image> pictures = develop(stage, fields, cameras, options);
    const auto black = [](const Image& picture) {
        return std::ranges::all_of(picture.pixels.elements(), [](float value) { return value == 0; });
    };
    // The edge of a hologram sends a little light everywhere, so completely black pictures mean an empty hologram.
    if (std::ranges::all_of(pictures, black))
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is empty; no light comes from it to the eye", options.input));
    const auto finite = [](const Image& picture) {
        return std::ranges::all_of(picture.pixels.elements(), [](float value) { return std::isfinite(value); });
    };
    if (!std::ranges::all_of(pictures, finite))
        throw Error(ErrorCode::bad_input, fmt::format("{}: holds samples that are not finite", options.input));
    return pictures;
}

std::vector<Image> photographs_of_light_field(Options& options, const Session& session, InputKind kind,
                                              bool geometric) {
    LightField light_field = open_or_render(session, options.input, options.render);
    const std::vector<Camera> cameras =
        make_cameras(options.view, light_field.grid().width(), light_field.grid().height());
    if (geometric) {
        with_parameter("pupil_samples, resolution", [&] {
            state_plan(session, plan_ray_photographs(light_field.grids(), cameras, {options.pupil_samples}),
                       "photographing by rays");
        });
        Stage stage(session, "geometric photograph");
        return photograph(light_field, cameras, {options.pupil_samples}, stage.progress());
    }
    light_field = with_common_directions(light_field);
    const HologramRequest request =
        options.hologram.request(light_field.grids(), session.seed, parse_looks(options.looks).count);
    session.say(options.hologram.note_about_pitch(request));
    check_holograms(light_field.grids(), request, kind == InputKind::scene, cameras);
    const CameraModel model = options.camera_model();
    if (!std::holds_alternative<PlaneWaveCamera>(model))
        options.camera = say_camera(session, light_field.grids(), request, cameras, model);
    state_plan(session, plan_photographs(light_field.grids(), request, cameras, model), "photographing the hologram");
    if (kind == InputKind::scene)
        light_field = prepare_for_reading(session, light_field, request.channels.size(), needs_depth(request.method));
    options.hologram.resolve(request, light_field.grid());
    const auto holograms = make_holograms(light_field, request);
    Stage stage(session, "wave photograph");
    return develop(stage, holograms, cameras, options);
}

// Throws Error(usage) for options that exclude each other.
void require_sense(const Options& options, InputKind kind, bool geometric) {
    if (kind == InputKind::hologram && options.geometric)
        throw Error(ErrorCode::usage, "--geometric: a hologram has no rays to follow; give its light field or scene");
    if (geometric && options.camera != "auto")
        throw Error(ErrorCode::usage,
                    fmt::format("--camera {}: photographs waves; give --wave or a hologram", options.camera));
    if (kind == InputKind::hologram && options.camera == "eye")
        throw Error(ErrorCode::usage,
                    "--camera eye: needs the hogels of a light field or a scene; of a hologram only samples are known");
    const bool expected = parse_looks(options.looks).expected;
    if (expected && kind == InputKind::hologram)
        throw Error(ErrorCode::usage,
                    "--looks expected: needs the hogels of a light field or a scene; of a hologram only samples are "
                    "known");
    if (expected && geometric)
        throw Error(ErrorCode::usage, "--looks expected: is of waves, and rays have no speckle; give --wave");
    if (expected && (options.camera == "narrow" || options.camera == "full"))
        throw Error(
            ErrorCode::usage,
            fmt::format("--looks expected: needs the hogels, not samples; leave out --camera {}", options.camera));
    if (options.preview && (geometric || expected || kind == InputKind::hologram || options.camera == "narrow" ||
                            options.camera == "full"))
        throw Error(ErrorCode::usage,
                    "--preview: leaves out waves of the hogels of a light field or a scene; give --wave, a number of "
                    "looks and --camera eye");
    if (options.resume && options.display == "phase")
        throw Error(ErrorCode::usage, "--resume: photographs of phases do not keep what is done; leave it out");
    if (options.has_diffuser() && kind != InputKind::hologram)
        throw Error(ErrorCode::usage,
                    "--diffuser vertical: stands before a hologram file; make one with 'hogel hologram "
                    "--method lines'");
    if (options.has_diffuser() && options.camera == "full")
        throw Error(ErrorCode::usage, "--diffuser vertical: is of the narrow-band camera; leave out --camera full");
    if (options.film_distance != 0 && options.camera != "full")
        throw Error(ErrorCode::usage, "--film-distance: the thin lens belongs to the full camera; add --camera full");
    if (options.display == "phase" && (options.camera != "full" || options.film_distance != 0))
        throw Error(ErrorCode::usage,
                    "--display phase: is that of the full camera with a perfect lens; add --camera full");
}

// The factor of all pictures, the same so that a movie does not flicker.
// @param given  0: automatic
double exposure_of(const Options& options, double given, std::span<const Image> pictures) {
    if (options.display != "intensity") return 1;
    if (given > 0) return given;
    double exposure = automatic_exposure(pictures.front());
    for (const Image& picture : pictures) exposure = std::min(exposure, automatic_exposure(picture));
    return exposure;
}

// Writes the pictures and reports them.
void write_photographs(const Options& options, std::span<const Image> pictures, double exposure, bool geometric,
                       const Session& session) {
    if (!is_first_process()) return;
    Metadata metadata = run_metadata(session);
    metadata.emplace_back("exposure", fmt::format("{:.9g}", exposure));
    const Image& first = pictures.front();
    std::uintmax_t bytes = 0;
    const bool movie = options.view.frames > 1;
    if (movie) {
        Stage stage(session, "writing the pictures");
        bytes = write_movie(options.output, pictures, exposure, options.view.frame_rate, metadata, stage.progress());
    } else {
        write_image(options.output, first, exposure, metadata);
        bytes = std::filesystem::file_size(options.output);
    }
    session.say(fmt::format("{}: {}{}x{} pixels, exposure {:.6g}", options.output,
                            movie ? fmt::format("{} pictures of ", pictures.size()) : "", first.width(), first.height(),
                            exposure));
    session.result({{"file", options.output},
                    {"bytes", bytes},
                    {"pictures", pictures.size()},
                    {"width", first.width()},
                    {"height", first.height()},
                    {"channels", first.channels()},
                    {"exposure", exposure},
                    {"geometric", geometric},
                    {"seconds", session.seconds()}});
}

int photo(Options& options, const Session& session) {
    const double given = options.exposure == "auto" ? 0 : parse_exposure(options.exposure);
    const bool external = is_external(options.input, options.field);
    if (!external) require_described(options.input, options.field);
    const InputKind kind = external ? InputKind::hologram : input_kind(options.input);
    if (options.view.frames > 1)
        with_parameter("frames", [&] { require_movie(options.output); });
    else
        require_picture_name(options.output);
    require_writable(options.output, {&options.input, 1});
    const bool geometric = options.geometric || (kind == InputKind::light_field && !options.wave);
    require_sense(options, kind, geometric);
    options.kind = kind;
    options.geometric = geometric;
    options.wave = !geometric;
    options.view.is_film = options.view.frames > 1 && is_film(options.output);
    Kept kept(session, options.resume, options.output, options.resume ? describe_input(options.input) : "");
    std::vector<Image> pictures = kind == InputKind::hologram
                                      ? photographs_of_hologram(options, session)
                                      : photographs_of_light_field(options, session, kind, geometric);
    if (options.display == "log")
        for (Image& picture : pictures) picture = logarithmic(picture);
    write_photographs(options, pictures, exposure_of(options, given, pictures), geometric, session);
    kept.complete();
    return 0;
}

void add_photo_options(Command& command, Options& options) {
    command.group("Camera");
    add_looks_option(command, "--looks,--average", options.looks,
                     "Photographs averaged against speckle, unless of a hologram file")
        .acts_if([&options] { return options.hologram.is_made && options.hologram.is_seeded; });
    command.text("--exposure", options.exposure, "NUMBER|auto", "What linear values are multiplied by in PNG, or auto")
        .acts_if([&options] { return options.is_exposed(); });
    command.choice("--display", options.display, {"intensity", "log", "phase"}, "intensity|log|phase",
                   "What a photograph by waves shows:"
                   "\nintensity: linear light"
                   "\nlog: four decades of it from black to white"
                   "\nphase: its phase beside that of light through the middle of the lens, from -pi to pi");
    add_wave_camera_option(command, options.camera, {"auto", "eye", "narrow", "full"}).acts_if([&options] {
        return !options.geometric;
    });
    command
        .flag("--preview", options.preview,
              "Without waves that pass far from the lens: a quick look, for the camera eye")
        .acts_if([&options] { return options.preview; });
    command
        .length("--film-distance", options.film_distance,
                "From a thin lens to its film, for the full camera, with its aberrations; 0mm: a perfect lens")
        .acts_if([&options] { return !options.geometric && options.camera == "full"; });
    command
        .choice("--diffuser", options.diffuser, {"none", "vertical"}, "none|vertical",
                "What stands before a hologram with horizontal parallax only:"
                "\nvertical: a diffuser that spreads the light of each line to all heights")
        .acts_if([&options] { return options.kind == InputKind::hologram && options.camera != "full"; });
    const Parameter& geometric =
        command.flag("--geometric", options.geometric, "By rays rather than waves (default for a light field)")
            .acts_if([&options] { return options.geometric; });
    command.flag("--wave", options.wave, "By waves, through the hologram (default for a scene)")
        .excludes(geometric)
        .acts_if([&options] { return options.wave && options.kind != InputKind::hologram; });
    command.count("--pupil-samples", options.pupil_samples, "Points of the pupil in a geometric photograph")
        .acts_if([&options] { return options.geometric; });
}

}  // namespace

void add_photo(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel photo hologram.h5 -o left.png --eye -30,0,300mm --focus 5mm\n"
        "  hogel photo pumpkin.h5 -o truth.exr --focus -4mm\n"
        "  hogel photo pumpkin -o wave.png --hogels 128x128 --size 8mm --looks 8\n"
        "  hogel photo hologram.h5 -o stack.mp4 --focus -6mm --to-focus 6mm --frames 24\n"
        "  hogel photo phase.png -o p.png --phase-code slmsuite --pitch 8um --wavelength 532nm");
    command.basics({"eye", "gaze", "focus", "pupil", "resolution", "looks", "exposure", "camera", "wave", "frames"});
    command.positional("input", options->input, "F.h5|X.h5|SCENE",
                       "Hologram, light field, mesh file, built-in scene, another program's field or picture");
    command.text("-o,--output", options->output, "FILE", "Picture to write: .png (sRGB) or .exr (linear)")
        .required()
        .never_acts();
    add_resume_flag(command, options->resume);
    add_camera_options(command, options->view);
    add_photo_options(command, *options);
    options->hologram.declare(command);
    options->render.declare(command);
    options->render.declare_hemicube(command);
    command.look_up("seed")->acts_if([options] { return options->hologram.is_seeded && !options->is_expected(); });
    add_field_options(command, options->field, false);
    add_reconstruction_options(command, options->field);
    command.add_like_option();
    command.work([options, &session] {
        options->camera = camera_name(options->camera);
        return photo(*options, session);
    });
}

}  // namespace hogel::cli
