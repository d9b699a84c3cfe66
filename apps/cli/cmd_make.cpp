// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>

#include "camera_options.h"
#include "commands.h"
#include "error_parameters.h"
#include "hogel/pipeline.h"
#include "hogel/progress.h"
#include "hogel/resources.h"
#include "hogel/team.h"
#include "hogel/units.h"
#include "hologram_pitch.h"
#include "inputs.h"
#include "like.h"
#include "outputs.h"
#include "report.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene, output;
    RenderOptions render;
    HologramChoices hologram;
    double eye_distance = defaults.eye_distance;
    double pupil = defaults.pupil;
    std::size_t resolution = defaults.resolution;
    std::string looks;  // empty: enough_looks()
    std::size_t pupil_samples = defaults.pupil_samples;
    std::string camera = "auto";
    bool store_hologram = false, keep_light_field = false, force = false, resume = false;

    /// What is made, which decides which options act. The report lists those of all.
    enum class Output { light_field, hologram, photographs, expected_photographs, ray_photographs, report };
    Output made = Output::report;
    bool is_one_of(std::initializer_list<Output> outputs) const {
        return made == Output::report || std::ranges::count(outputs, made) > 0;
    }
    bool is_photograph() const {
        return is_one_of({Output::photographs, Output::expected_photographs, Output::ray_photographs});
    }
};

struct Focus {
    std::string name;
    double depth;
};

// Two focuses: a sixth of the scene's depth behind its nearest point, and as much in front of its farthest.
std::array<Focus, 2> focuses(const Scene& scene, double eye_distance) {
    const Bounds box = bounds(scene);
    const double front = -box.high.z, back = -box.low.z, sixth = (back - front) / 6;
    return {Focus{"near", std::max(front + sixth, -0.5 * eye_distance)}, Focus{"far", back - sixth}};
}

// Three eyes, left, high and right, as far from the axis as every hogel still sends rays to the whole lens.
std::array<std::pair<std::string, Vec3>, 3> eyes(const Options& options, const LightFieldGrid& grid) {
    const double half_width = 0.5 * grid.pitch * static_cast<double>(std::max(grid.hogels_s, grid.hogels_t));
    const double margin = half_width + 0.5 * options.pupil, tangent = std::min(grid.half_u(), grid.half_v());
    const double reach = options.eye_distance * tangent - margin;
    if (!(reach > 0))
        throw Error(ErrorCode::usage,
                    fmt::format("--eye-distance: at {} the field of view does not cover the whole hologram; it does "
                                "beyond {}",
                                format_length(options.eye_distance), format_length(margin / tangent)));
    const double aside = 0.7 * reach, z = options.eye_distance;
    return {{{"left", {-aside, 0, z}}, {"high", {0, aside, z}}, {"right", {aside, 0, z}}}};
}

std::vector<PhotographPair> plan_photographs(const Options& options, const Scene& scene, const LightFieldGrid& grid) {
    std::vector<PhotographPair> pairs;
    for (const Focus& focus : focuses(scene, options.eye_distance))
        for (const auto& [eye_name, eye] : eyes(options, grid)) {
            PhotographPair pair;
            pair.eye_name = eye_name;
            pair.focus_name = focus.name;
            pair.camera = camera_for(grid.pitch * static_cast<double>(grid.hogels_s),
                                     grid.pitch * static_cast<double>(grid.hogels_t), options.resolution);
            pair.camera.eye = eye;
            pair.camera.focus_depth = focus.depth;
            pair.camera.pupil = options.pupil;
            validate(pair.camera);
            pair.wave_file = fmt::format("photo_{}_{}", eye_name, focus.name);
            pair.geometric_file = pair.wave_file + "_geometric";
            pair.expected_file = pair.wave_file + "_expected";
            pairs.push_back(pair);
        }
    return pairs;
}

// Runs a stage of the work, prints how long it took, and keeps the time for the report.
template <class Work>
void timed(const Session& session, Report& report, const std::string& name, Work work) {
    Stage stage(session, name);
    work(stage);
    report.stages.emplace_back(name, stage.seconds());
    session.say(fmt::format("{:<24} {:8.1f} s", name, stage.seconds()));
}

// Calls work(i) for all i below `count` on as many threads as there are; an error of one is thrown in the end. A stop
// ends the work of each.
void on_all_threads(const Session& session, std::size_t count, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::future<void>> threads;
    for (std::size_t thread = 0; thread < std::min(count, thread_count()); ++thread)
        threads.push_back(std::async(std::launch::async, [&] {
            const Stoppable stoppable(Progress(session.stop.get_token()));
            for (std::size_t i = next++; i < count; i = next++) work(i);
        }));
    for (std::future<void>& thread : threads) thread.wait();
    for (std::future<void>& thread : threads) thread.get();
}

void compare_pictures(const Session& session, Report& report) {
    on_all_threads(session, report.pairs.size(), [&](std::size_t i) {
        PhotographPair& pair = report.pairs[i];
        if (report.looks > 0) pair.comparison = compare(pair.geometric, pair.wave, report.exposure);
        if (report.expected) pair.expected_comparison = compare(pair.geometric, pair.expected, report.exposure);
    });
}

void write_pictures(const Session& session, const std::filesystem::path& folder, const Report& report) {
    const auto with_exposure = [&](Metadata metadata) {
        metadata.emplace_back("exposure", fmt::format("{:.9g}", report.exposure));
        return metadata;
    };
    const Metadata wave = with_exposure(report.waves_run), expected = with_exposure(report.expected_run),
                   rays = with_exposure(report.rays_run);
    std::vector<std::function<void()>> works;
    for (const PhotographPair& pair : report.pairs)
        for (const char* extension : {".png", ".exr"}) {
            const auto add = [&](const std::string& file, const Image& image, const Metadata& metadata) {
                works.push_back(
                    [&, path = folder / (file + extension)] { write_image(path, image, report.exposure, metadata); });
            };
            if (report.looks > 0) add(pair.wave_file, pair.wave, wave);
            if (report.expected) add(pair.expected_file, pair.expected, expected);
            add(pair.geometric_file, pair.geometric, rays);
        }
    on_all_threads(session, works.size(), [&](std::size_t i) { works[i](); });
}

// Prints the resources that the work needs, and returns the camera that is chosen. Throws if they are not available.
std::string state_plan(const LightFieldGrid& grid, const HologramRequest& request, std::span<const Camera> cameras,
                       const CameraModel& model, const Session& session) {
    const std::span<const LightFieldGrid> faces(&grid, 1);
    std::string camera = say_camera(session, faces, request, cameras, model);
    state_plan(session, plan_photographs(faces, request, cameras, model), "photographing the hologram");
    return camera;
}

// Whether pictures of infinitely many looks take no longer than those of the looks, or no more than ten seconds. They
// take long where many waves of a hogel enter the lens: where hogels are large.
bool is_expected_cheap(const LightFieldGrid& grid, const HologramRequest& request, std::span<const Camera> cameras,
                       const CameraModel& model, const Session& session) {
    const std::span<const LightFieldGrid> faces(&grid, 1);
    const double looks = plan_photographs(faces, request, cameras, model).seconds,
                 expected = plan_photographs(faces, request, cameras, SpeckleFreeCamera()).seconds;
    if (expected <= std::max(10.0, looks)) return true;
    session.detail(
        fmt::format("without pictures of infinitely many looks, which take about {:.0f} s; --looks expected "
                    "makes them",
                    expected));
    return false;
}

// The command that renders the light field again.
// @param run  what the light field says of the run
std::string render_command(Metadata run) {
    for (auto& [key, value] : run)
        if (key == "command") value = "hogel render";
    return command_line_of(run) + " -o lightfield.h5";
}

// A file that is removed in the end, unless it is to be kept.
class PassingFile {
  public:
    PassingFile(std::filesystem::path path, bool keep) : path_(std::move(path)), keep_(keep) {}
    void keep(bool keep) { keep_ = keep; }
    PassingFile(const PassingFile&) = delete;
    PassingFile& operator=(const PassingFile&) = delete;
    ~PassingFile() {
        std::error_code none;
        if (!keep_ && is_first_process()) std::filesystem::remove(path_, none);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool keep_;
};

// Photographs the holograms by waves.
// @param with  the camera of the pictures of some looks; null: there are none
void photograph_waves(const Session& session, Report& report, const Fields& holograms, std::span<const Camera> cameras,
                      const CameraModel* with) {
    struct Way {
        std::string name;
        CameraModel camera;
        Image PhotographPair::*picture;
    };
    std::vector<Way> ways;
    if (with != nullptr) ways.push_back({"photographs by waves", *with, &PhotographPair::wave});
    if (report.expected) ways.push_back({"expected photographs", SpeckleFreeCamera(), &PhotographPair::expected});
    const auto photograph = [&](const std::string& name, std::span<const Way> some) {
        timed(session, report, name, [&](Stage& stage) {
            std::vector<CameraModel> by;
            for (const Way& way : some) by.push_back(way.camera);
            std::vector<std::vector<Image>> seen = photograph_colours(holograms, cameras, by, stage.progress());
            for (std::size_t way = 0; way < some.size(); ++way)
                for (std::size_t i = 0; i < cameras.size(); ++i)
                    report.pairs[i].*some[way].picture = std::move(seen[way][i]);
        });
    };
    // Processes of a team share all of them in one stage, so that none waits for the others between two.
    if (const Team* const all = team(); all != nullptr && all->size() > 1 && ways.size() > 1)
        return photograph(ways.front().name, ways);
    for (const Way& way : ways) photograph(way.name, std::span(&way, 1));
}

// The most important facts of report.json.
Result result_of(const Report& report, const std::string& folder, const Session& session) {
    ResultList photographs;
    for (const PhotographPair& pair : report.pairs) {
        const ImageComparison& seen = report.looks > 0 ? pair.comparison : pair.expected_comparison;
        Result files{{"file", (report.looks > 0 ? pair.wave_file : pair.expected_file) + ".png"}};
        if (report.expected) files.emplace_back("expected_file", pair.expected_file + ".png");
        files.insert(files.end(),
                     {{"geometric_file", pair.geometric_file + ".png"}, {"psnr", seen.psnr}, {"ssim", seen.ssim}});
        photographs.push_back(std::move(files));
    }
    const Grid& picture = report.pairs.front().camera.picture;
    return {{"folder", folder},
            {"report", "report.html"},
            {"triangles", report.triangles},
            {"wavelengths_m", wavelengths_of(report.holograms)},
            {"looks", report.looks},
            {"width", picture.width},
            {"height", picture.height},
            {"exposure", report.exposure},
            {"photographs", photographs},
            {"seconds", session.seconds()}};
}

// The same work was completed before.
int report_done(const Session& session, const std::string& folder) {
    session.say(fmt::format("{}: all is done", folder));
    session.result({{"folder", folder}, {"report", "report.html"}, {"seconds", session.seconds()}});
    return 0;
}

int make(Options& options, const Session& session) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_folder_name(options.output);
    require_hdf5(std::filesystem::path(options.output) / "lightfield.h5");
    require_picture_name("photo.png");
    require_picture_name("photo.exr");
    Report report;
    report.scene = options.scene;
    report.algorithm = options.render.algorithm;
    report.light_field = options.render.request().grid;
    report.pupil_samples = options.pupil_samples;
    report.threads = thread_count();
    using Output = Options::Output;
    const auto run_of = [&](Output output) {
        options.made = output;
        options.render.scene.is_loaded = options.is_one_of({Output::light_field});
        return run_metadata(session);
    };
    const Scene scene = load_scene(session, options.scene, options.render);
    report.triangles = triangle_count(scene);
    report.pairs = plan_photographs(options, scene, report.light_field);
    const Looks looks =
        options.looks.empty() ? Looks{enough_looks(report.pairs.front().camera)} : parse_looks(options.looks);
    report.looks = looks.expected ? 0 : looks.count;
    std::vector<Camera> cameras;
    for (const PhotographPair& pair : report.pairs) cameras.push_back(pair.camera);
    const HologramRequest request =
        request_for(std::span(&report.light_field, 1), options.hologram, session, looks.count);
    say_pitch(request, options.hologram, session);
    with_renamed_parameters({{"wavelength", "hogels, size"}},
                            [&] { require_holograms(std::span(&report.light_field, 1), request, cameras); });
    const CameraModel with = camera_model(options.camera, looks.expected);
    const std::string camera = state_plan(report.light_field, request, cameras, with, session);
    report.expected = looks.expected || is_expected_cheap(report.light_field, request, cameras, with, session);

    const std::filesystem::path done_before = std::filesystem::path(options.output) / "make";
    const bool resumes = options.resume && std::filesystem::exists(done_before.string() + ".part");
    report.scene_input = describe_input(options.scene, scene);
    report.work = work_of(session, report.scene_input);
    if (options.resume && !resumes && !options.force && has_report_of(options.output, report.work))
        return report_done(session, options.output);
    const OutputFolder folder(options.output, options.force || resumes);
    Kept kept(session, options.resume, done_before.string(), report.scene_input);
    const auto resume = options.resume ? std::optional(report.scene_input) : std::nullopt;
    PassingFile light_field_file(folder.path() / "lightfield.h5", options.keep_light_field || options.resume);

    timed(session, report, "light field", [&](Stage& stage) {
        const LightField rendered = render_light_field(session, scene, options.render);
        require_memory(session, rendered, options.render, scene);
        kept.once([&] {
            write_light_field(light_field_file.path(), rendered,
                              {.metadata = run_of(Output::light_field), .resume = resume}, stage.progress());
        });
    });
    report.render_command = render_command(run_of(Output::light_field));
    if (options.keep_light_field) report.light_field_bytes = std::filesystem::file_size(light_field_file.path());
    const LightField light_field = open_light_field(light_field_file.path());
    options.hologram.resolve(request, light_field.grid());
    options.camera = camera;
    options.looks = "expected";
    report.expected_run = run_of(Output::expected_photographs);
    options.looks = looks.expected ? "expected" : fmt::format("{}", report.looks);
    report.waves_run = run_of(Output::photographs);
    report.rays_run = run_of(Output::ray_photographs);
    report.run = run_of(Output::report);
    const auto holograms = make_holograms(light_field, request);
    for (const auto& hologram : holograms) report.holograms.push_back(hologram->grid());

    timed(session, report, "photographs by rays", [&](Stage& stage) {
        std::vector<Image> pictures = photograph(light_field, cameras, {options.pupil_samples}, stage.progress());
        for (std::size_t i = 0; i < pictures.size(); ++i) report.pairs[i].geometric = std::move(pictures[i]);
    });
    if (options.store_hologram)
        timed(session, report, "hologram file", [&](Stage& stage) {
            kept.once([&] {
                write_holograms(folder.path() / "hologram.h5", holograms,
                                {.metadata = run_of(Output::hologram), .resume = resume}, stage.progress());
            });
        });
    photograph_waves(session, report, holograms, cameras, looks.expected ? nullptr : &with);

    // One exposure for all pictures, from the view from above.
    report.exposure = automatic_exposure(report.pairs[1].geometric);
    if (!is_first_process()) return 0;
    compare_pictures(session, report);
    write_pictures(session, folder.path(), report);
    write_text(folder.path() / "report.json", report_json(report));
    write_text(folder.path() / "report.html", report_html(report, folder.path()));
    kept.complete();
    light_field_file.keep(options.keep_light_field);
    session.say("");
    session.say((folder.path() / "report.html").string());
    session.result(result_of(report, options.output, session));
    return 0;
}

}  // namespace

void add_make(Command& command, Session& session) {
    using Output = Options::Output;
    auto options = std::make_shared<Options>();
    options->hologram.wavelengths = {defaults.red, defaults.green, defaults.blue};
    command.examples(
        "  hogel make pumpkin -o pumpkin\n"
        "  hogel make bunny.ply -o bunny --hogels 128x128 --size 8mm --looks 4");
    command.basics(
        {"hogels", "directions", "size", "fov", "rotate", "light", "pupil", "eye-distance", "resolution", "looks"});
    command.positional("scene", options->scene, "SCENE", "Mesh file or built-in scene").acts_if([options] {
        return options->is_one_of({Output::light_field});
    });
    command.text("-o,--output", options->output, "DIR", "Folder for everything that is made").required().never_acts();
    add_force_flag(command, options->force);
    command
        .flag("--store-hologram", options->store_hologram,
              "Keep hologram.h5 too; otherwise it streams through and is never stored")
        .never_acts();
    command
        .flag("--keep-light-field", options->keep_light_field,
              "Keep lightfield.h5 too; the report has the command that renders it again")
        .never_acts();
    command
        .flag("--resume", options->resume,
              "Keep what is done when interrupted, in DIR, and go on from there the next time")
        .never_acts();
    command.group("Hologram");
    command
        .positive_length("--pitch", options->hologram.pitch,
                         "Distance of samples, rounded to divide a hogel; less by default where the field of view "
                         "needs it")
        .acts_if([options] {
            return options->is_one_of({Output::hologram, Output::photographs, Output::expected_photographs});
        });
    command.look_up("seed")->acts_if([options] { return options->is_one_of({Output::hologram, Output::photographs}); });
    command.group("Camera", [options] { return options->is_photograph(); });
    command.positive_length("--eye-distance", options->eye_distance, "Of the lens from the hologram's plane")
        .sets_parameter("eye")
        .sets_parameter("focus");
    command.positive_length("--pupil", options->pupil, "Diameter of the lens");
    add_wave_camera_option(command, options->camera, {"auto", "eye", "narrow"}).acts_if([options] {
        return options->is_one_of({Output::photographs});
    });
    command.count("--resolution", options->resolution, "Pixels across a photograph");
    add_looks_option(command, "--looks", options->looks,
                     "Photographs averaged against speckle; fewer are enough where a pixel holds much of it")
        .default_text(fmt::format("up to {}", defaults.looks))
        .acts_if([options] {
            return options->is_one_of({Output::photographs, Output::expected_photographs});
        });
    command.count("--pupil-samples", options->pupil_samples, "Points of the pupil in a photograph by rays")
        .acts_if([options] { return options->is_one_of({Output::ray_photographs}); });
    add_render_options(command, options->render);
    command.add_like_option();
    command.work([options, &session] {
        options->camera = camera_name(options->camera);
        return make(*options, session);
    });
}

}  // namespace hogel::cli
