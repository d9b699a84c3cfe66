// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "hogel/bench.h"
#include "hogel/communicator.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "movie.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    LightFieldParameters render;
    HologramParameters hologram;
    FieldParameters field;
    PhotoParameters photo;
    bool resume = false;

    // Returns the camera model. The full camera puts its scratch files into the picture's folder.
    CameraModel camera_model() const {
        CameraModel model = photo.waves.model();
        if (auto* const full = std::get_if<PlaneWaveCamera>(&model))
            full->scratch.folder = std::filesystem::absolute(output).parent_path();
        return model;
    }
};

// Photographs the intensity or the phase.
std::vector<Image> photograph_fields(Stage& stage, const Fields& fields, std::span<const Camera> cameras,
                                     const Options& options) {
    if (options.photo.display != "phase")
        return with_parameter(
            "camera", [&] { return photograph_colours(fields, cameras, options.camera_model(), stage.progress()); });
    if (fields.size() != 1)
        throw Error(ErrorCode::usage, "display",
                    fmt::format("phase needs a single wavelength, but there are {}", fields.size()));
    std::vector<Image> pictures;
    for (const auto& wave : waves_in_focus(*fields.front(), 0, cameras,
                                           std::get<PlaneWaveCamera>(options.camera_model()), stage.progress()))
        pictures.push_back(picture_of(wave, FieldQuantity::phase));
    return pictures;
}

// Throws Error(bad_input) for a number of wavelengths that a photograph does not take.
void require_colours(const Options& options, const Fields& fields) {
    if (fields.size() != 1 && fields.size() != 3)
        throw Error(ErrorCode::bad_input, fmt::format("{}: has {} wavelengths; a photograph takes one or three",
                                                      options.input, fields.size()));
}

std::vector<Image> photographs_of_hologram(Options& options, const Session& session) {
    options.field.pitch = options.hologram.pitch;
    options.field.wavelengths = options.hologram.wavelengths;
    const Fields fields = open_and_reconstruct(session, options.input, options.field);
    options.hologram.resolve(options.field);
    require_colours(options, fields);
    const Grid& plane = fields.front()->grid().plane;
    const std::vector<Camera> cameras = options.photo.view.cameras(plane.size_x(), plane.size_y());
    if (options.photo.waves.camera == "auto") options.photo.waves.camera = "narrow";
    const CameraModel model = options.camera_model();
    with_renamed_parameters({{"pitch", ""}}, [&] {  // the pitch is a property of the field
        std::vector<FieldGrid> grids;
        for (const auto& field : fields) {
            for (const Camera& camera : cameras)
                require_light_towards(field->grid(), camera, options.photo.waves.diffuser == "vertical");
            grids.push_back(field->grid());
        }
        if (std::holds_alternative<BandCamera>(model))
            check_plan(session, plan_photographs(grids, fields.front()->looks(), cameras, model),
                       "photographing the hologram");
    });
    Stage stage(session, "wave photograph");
    std::vector<Image> pictures = photograph_fields(stage, fields, cameras, options);
    const auto black = [](const Image& picture) {
        return std::ranges::all_of(picture.pixels.elements(), [](float value) { return value == 0; });
    };
    // The edge of a hologram diffracts some light everywhere, so completely black pictures mean an empty hologram.
    if (std::ranges::all_of(pictures, black))
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is empty; no light comes from it to the eye", options.input));
    const auto finite = [](const Image& picture) {
        return std::ranges::all_of(picture.pixels.elements(), [](float value) { return std::isfinite(value); });
    };
    if (!std::ranges::all_of(pictures, finite))
        throw Error(ErrorCode::bad_input, fmt::format("{}: contains samples that are not finite", options.input));
    return pictures;
}

// Prints the measures of a photograph on the bench, and returns them for --json.
Result report_bench(const FieldGrid& grid, const Bench& bench, const BenchPhotograph& photograph,
                    const Session& session) {
    const double radius = 0.61 * grid.wavelength * bench.focal_length / photograph.resolution;
    std::string waves = photograph.points == 1 ? "" : fmt::format(", {} points", photograph.points);
    if (photograph.wavelengths > 1) waves += fmt::format(", {} wavelengths", photograph.wavelengths);
    session.say(fmt::format(
        "{}: bench: aperture radius {:.3g} mm, resolution {:.3g} um, efficiency {:.2f} %, speckle "
        "contrast {:.3f}{}{}",
        format_length(grid.wavelength), radius * 1e3, photograph.resolution * 1e6, 100 * photograph.efficiency,
        photograph.contrast, waves, photograph.is_converged ? "" : ", fewer than this led needs"));
    return {{"wavelength_m", grid.wavelength},
            {"focus_m", bench.focus},
            {"aperture_m", radius},
            {"resolution_m", photograph.resolution},
            {"efficiency", photograph.efficiency},
            {"speckle_contrast", photograph.contrast},
            {"source_points", photograph.points},
            {"source_wavelengths", photograph.wavelengths},
            {"converged", photograph.is_converged}};
}

// Photographs patterns of one or three wavelengths on the bench; adds its measures to the results.
std::vector<Image> photographs_on_bench(Options& options, const Session& session, ResultList& results) {
    const BenchParameters& bench = options.photo.bench;
    options.field.pitch = options.hologram.pitch;
    options.field.wavelengths = options.hologram.wavelengths;
    const OpenedFields opened = [&] {
        Stage opening(session, "opening the pattern");
        return options.field.open(options.input, *session.command);
    }();
    for (const std::string& note : opened.notes) session.say(note);
    options.hologram.resolve(options.field);
    const Fields& patterns = opened.fields;
    require_colours(options, patterns);
    if (patterns.size() > 1 && parse_light_source(bench.source).kind == LightSource::Kind::led)
        throw Error(ErrorCode::usage, "source",
                    fmt::format("a led has one mean wavelength, but {} has three", options.input));
    for (const std::string& note : bench.notes(options.input, patterns)) session.say(note);
    const CameraParameters& view = options.photo.view;
    Stage stage(session, "photograph on the bench");
    std::vector<Image> pictures;
    for (std::size_t i = 0; i < view.frames; ++i) {
        const double part = view.frames > 1 ? static_cast<double>(i) / static_cast<double>(view.frames - 1) : 0;
        const double focus = view.focus + part * (view.last_focus.value_or(view.focus) - view.focus);
        Image& picture = pictures.emplace_back();
        for (std::size_t c = 0; c < patterns.size(); ++c) {
            const FieldSource& pattern = *patterns[c];
            const Bench used = bench.bench(options.input, pattern, options.field, focus);
            const BenchPhotograph channel = photograph_on_bench(
                pattern, used, stage.progress(i * patterns.size() + c, view.frames * patterns.size()));
            if (c == 0) picture.reset(channel.picture.width(), channel.picture.height(), patterns.size());
            const auto power = static_cast<float>(bench.power(options.input, pattern.grid().wavelength));
            for (std::size_t k = 0; k < channel.picture.pixels.size(); ++k)
                picture.pixels.data()[k * patterns.size() + c] = power * channel.picture.pixels.data()[k];
            results.push_back(report_bench(pattern.grid(), used, channel, session));
        }
    }
    return pictures;
}

std::vector<Image> photographs_by_rays(const Options& options, const LightField& light_field,
                                       std::span<const Camera> cameras, const Session& session) {
    const RayCamera rays{options.photo.pupil_samples};
    with_parameter("pupil_samples, resolution", [&] {
        check_plan(session, plan_ray_photographs(light_field.grids(), cameras, rays), "photographing by rays");
    });
    Stage stage(session, "geometric photograph");
    return photograph(light_field, cameras, rays, stage.progress());
}

std::vector<Image> photographs_of_light_field(Options& options, const Session& session, InputKind kind) {
    LightField light_field = open_or_render(session, options.input, options.render);
    const std::vector<Camera> cameras =
        options.photo.view.cameras(light_field.grid().width(), light_field.grid().height());
    if (options.photo.geometric) return photographs_by_rays(options, light_field, cameras, session);
    light_field = with_common_directions(light_field);
    WaveCameraParameters& waves = options.photo.waves;
    const HologramRequest request =
        options.hologram.request(light_field.grids(), session.seed, waves.number_of_looks());
    session.say(options.hologram.note_about_pitch(request, light_field.grid()));
    check_holograms(light_field.grids(), request, kind == InputKind::scene, cameras);
    if (waves.camera != "full") {
        const std::string reason = waves.resolve(light_field.grids(), request, cameras);
        session.detail(fmt::format("camera: {}, because {}", waves.camera, reason));
    }
    check_plan(session, plan_photographs(light_field.grids(), request, cameras, options.camera_model()),
               "photographing the hologram");
    if (kind == InputKind::scene)
        light_field = prepare_for_reading(session, light_field, request.channels.size(), needs_depth(request.method));
    options.hologram.resolve(request, light_field.grid());
    waves.has_looks = options.hologram.is_seeded;
    const auto holograms = make_holograms(light_field, request);
    Stage stage(session, "wave photograph");
    return photograph_fields(stage, holograms, cameras, options);
}

// Resolves the source of the photographs. Throws Error(usage) for options that exclude each other.
void resolve(Options& options, InputKind kind) {
    PhotoParameters& photo = options.photo;
    const bool by_rays = photo.geometric || (kind == InputKind::light_field && !photo.wave);
    photo.resolve(kind == InputKind::hologram ? PhotographSource::samples
                  : by_rays                   ? PhotographSource::rays
                                              : PhotographSource::hogels);
    if (options.resume && photo.display == "phase")
        throw Error(ErrorCode::usage, "resume", "photographs of phases cannot be resumed; leave it out");
    if (photo.waves.diffuser == "vertical" && kind != InputKind::hologram)
        throw Error(ErrorCode::usage, "diffuser",
                    "vertical requires a hologram file; make one with 'hogel hologram --method lines'");
    photo.view.is_film = photo.view.frames > 1 && is_film(options.output);
    photo.is_linear = std::filesystem::path(options.output).extension() == ".exr";
}

// Returns the common exposure of all pictures, which avoids flicker in films.
// @param given  0: automatic
double exposure_of(const Options& options, double requested_exposure, std::span<const Image> pictures) {
    if (options.photo.display != "intensity") return 1;
    if (requested_exposure > 0) return requested_exposure;
    double exposure = automatic_exposure(pictures.front());
    for (const Image& picture : pictures) exposure = std::min(exposure, automatic_exposure(picture));
    return exposure;
}

// Writes the pictures and reports them.
// @param bench  measures of the bench, if the pictures are of it
void write_photographs(const Options& options, std::span<const Image> pictures, double exposure,
                       const ResultList& bench, const Session& session) {
    if (!is_root_rank()) return;
    Metadata metadata = run_metadata(session);
    metadata.emplace_back("exposure", fmt::format("{:.9g}", exposure));
    const Image& first = pictures.front();
    std::uintmax_t bytes = 0;
    const bool movie = options.photo.view.frames > 1;
    if (movie) {
        Stage stage(session, "writing the pictures");
        bytes =
            write_movie(options.output, pictures, exposure, options.photo.view.frame_rate, metadata, stage.progress());
    } else {
        write_image(options.output, first, exposure, metadata);
        bytes = std::filesystem::file_size(options.output);
    }
    session.say(fmt::format("{}: {}{}x{} pixels, exposure {:.6g}", options.output,
                            movie ? fmt::format("{} pictures of ", pictures.size()) : "", first.width(), first.height(),
                            exposure));
    Result result{{"file", options.output},      {"bytes", bytes},
                  {"pictures", pictures.size()}, {"width", first.width()},
                  {"height", first.height()},    {"channels", first.channels()},
                  {"exposure", exposure},        {"geometric", options.photo.geometric},
                  {"seconds", session.seconds()}};
    if (!bench.empty()) result.emplace_back("bench", bench);
    session.result(result);
}

int photo(Options& options, const Session& session) {
    const double requested_exposure = parse_exposure(options.photo.exposure);
    const Command& given = *session.command;
    if (given.given("--pitch") && !given.given("--wave") && !given.given("--like"))
        options.field.require_described(options.input);
    options.photo.bench.describe(options.input, options.field);
    const InputKind kind = options.field.is_external(options.input) ? InputKind::hologram : input_kind(options.input);
    options.photo.bench.resolve(options.input, options.field, given);
    if (options.photo.view.frames > 1)
        with_parameter("frames", [&] { require_movie(options.output); });
    else
        require_picture_name(options.output);
    require_writable(options.output, {&options.input, 1});
    resolve(options, kind);
    ResumableOutput resumable(session, options.resume, options.output,
                              options.resume ? describe_input(options.input) : "");
    ResultList bench;
    std::vector<Image> pictures = options.photo.bench.is_used   ? photographs_on_bench(options, session, bench)
                                  : kind == InputKind::hologram ? photographs_of_hologram(options, session)
                                                                : photographs_of_light_field(options, session, kind);
    if (options.photo.display == "log")
        for (Image& picture : pictures) picture = logarithmic(picture);
    write_photographs(options, pictures, exposure_of(options, requested_exposure, pictures), bench, session);
    resumable.complete();
    return 0;
}

}  // namespace

void add_photo(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel photo hologram.h5 -o left.png --eye -30,0,300mm --focus 5mm\n"
        "  hogel photo pumpkin.h5 -o truth.exr --focus -4mm\n"
        "  hogel photo pumpkin -o wave.png --hogels 128x128 --size 8mm --looks 8\n"
        "  hogel photo hologram.h5 -o stack.mp4 --focus -6mm --to-focus 6mm --frames 24\n"
        "  hogel photo pattern.png -o bench.png --focal 200mm --focus -200mm --source led:520nm,30nm,0.5mm\n"
        "  hogel photo phase.png -o p.png --phase-code slmsuite --pitch 8um --wavelength 532nm");
    command.basics({"eye", "gaze", "focus", "pupil", "resolution", "looks", "exposure", "camera", "wave", "frames"});
    command.positional("input", options->input, "F.h5|X.h5|SCENE",
                       "Hologram, light field, picture, mesh file, built-in scene, or another program's field");
    command.text("-o,--output", options->output, "FILE", "Picture to write: .png (sRGB) or .exr (linear)")
        .required()
        .never_acts();
    add_resume_flag(command, options->resume);
    options->photo.declare(command);
    options->hologram.declare(command);
    options->render.declare(command);
    options->render.declare_hemicube(command);
    command.look_up("seed")->acts_if(
        [options] { return options->hologram.is_seeded && !options->photo.waves.is_speckle_free(); });
    options->field.declare(command, false);
    options->field.declare_reconstruction(command, true);
    command.add_like_option();
    command.work([options, &session] { return photo(*options, session); });
}

}  // namespace hogel::cli
