// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <optional>
#include <utility>

#include "commands.h"
#include "hogel/communicator.h"
#include "hogel/make.h"
#include "hogel/parameters.h"
#include "hogel/progress.h"
#include "hogel/units.h"
#include "inputs.h"
#include "like.h"
#include "outputs.h"
#include "report.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string scene, output;
    MakeParameters make;
    bool store_hologram = false, keep_light_field = false, force = false, resume = false;
};

// Consecutive stages of the work. Prints the time of each and stores it in the report.
class Stages {
  public:
    Stages(const Session& session, Report& report) : session_(session), report_(report) {}
    // Begins a stage; continues the current one if it has the same name.
    Progress begin(const std::string& name) {
        if (!stage_ || name_ != name) {
            end();
            name_ = name;
            stage_.emplace(session_, name);
        }
        return stage_->progress();
    }
    void end() {
        if (!stage_) return;
        report_.stages.emplace_back(name_, stage_->seconds());
        session_.say(fmt::format("{:<24} {:8.1f} s", name_, stage_->seconds()));
        stage_.reset();
    }

  private:
    const Session& session_;
    Report& report_;
    std::string name_;
    std::optional<Stage> stage_;
};

// Prints the resources that the work needs. Chooses the camera and whether to take speckle-free photographs. Throws if
// the resources are not available.
void check_plan(MakeRequest& request, Options& options, const Session& session) {
    const std::vector<LightFieldGrid> faces = request.light_field.grids();
    const std::vector<Camera> cameras = cameras_of(request);
    WaveCameraParameters& waves = options.make.waves;
    const std::string reason = waves.resolve(faces, request.hologram, cameras);
    session.detail(fmt::format("camera: {}, because {}", waves.camera, reason));
    check_plan(session, plan_photographs(faces, request.hologram, cameras, request.camera),
               "photographing the hologram");
    request.speckle_free =
        waves.is_speckle_free() || is_speckle_free_cheap(faces, request.hologram, cameras, request.camera);
    if (!*request.speckle_free)
        session.detail(
            fmt::format("no speckle-free photographs, which take about {:.0f} s; request them with --speckle none",
                        plan_photographs(faces, request.hologram, cameras, SpeckleFreeCamera()).seconds));
}

// Returns the command that renders the light field again.
// @param run  metadata of the light field
std::string render_command(const Metadata& run) {
    Metadata rendering = run;
    for (auto& entry : rendering)
        if (entry.first == "command") entry.second = "hogel render";
    return command_line_of(rendering) + " -o lightfield.h5";
}

// File that the destructor removes unless it is to be kept.
class TemporaryFile {
  public:
    TemporaryFile(std::filesystem::path path, bool keep) : path_(std::move(path)), keep_(keep) {}
    void keep(bool keep) { keep_ = keep; }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        std::error_code ignored;
        if (!keep_ && is_root_rank()) std::filesystem::remove(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool keep_;
};

// Metadata of the outputs and the report, with the options that acted on each.
struct Records {
    Metadata light_field, hologram, waves, speckle_free, rays, report;
};

// Returns the metadata of all outputs. Sets options to the values that were chosen.
Records records_of(MakeParameters& make, const MakeRequest& request, const Session& session) {
    using Output = MakeParameters::Output;
    const auto record_of = [&](Output output) {
        make.made = output;
        make.render.scene.is_loaded = make.is_one_of({Output::light_field});
        return run_metadata(session);
    };
    Records records;
    records.light_field = record_of(Output::light_field);
    make.hologram.resolve(request.hologram, request.light_field.grid);
    const std::string speckle = std::exchange(make.waves.speckle, "none");
    records.speckle_free = record_of(Output::speckle_free_photographs);
    make.waves.speckle = speckle;
    make.waves.looks = fmt::format("{}", request.hologram.looks);
    records.waves = record_of(Output::photographs);
    records.rays = record_of(Output::ray_photographs);
    records.hologram = record_of(Output::hologram);
    records.report = record_of(Output::report);
    return records;
}

// Returns the main facts of report.json.
Result result_of(const Made& made, std::size_t triangles, const std::string& folder, const Session& session) {
    ResultList photographs;
    for (const MadePhotographs& entry : made.photographs) {
        const std::string wave_file = entry.waves ? entry.camera.wave_file() : entry.camera.speckle_free_file();
        const ImageComparison& comparison = (entry.waves ? entry.waves : entry.speckle_free)->comparison;
        Result files{{"file", wave_file + ".png"}};
        if (entry.speckle_free) files.emplace_back("expected_file", entry.camera.speckle_free_file() + ".png");
        files.insert(files.end(), {{"geometric_file", entry.camera.ray_file() + ".png"},
                                   {"psnr", comparison.psnr},
                                   {"ssim", comparison.ssim}});
        photographs.push_back(std::move(files));
    }
    const Grid& picture = made.photographs.front().camera.camera.picture;
    return {{"folder", folder},           {"report", "report.html"},
            {"triangles", triangles},     {"wavelengths_m", wavelengths_of(grids_of(made))},
            {"looks", looks_of(made)},    {"width", picture.width},
            {"height", picture.height},   {"exposure", made.exposure},
            {"photographs", photographs}, {"seconds", session.seconds()}};
}

// Reports that a previous run completed the same work.
int report_done(const Session& session, const std::string& folder) {
    session.say(fmt::format("{}: is complete already", folder));
    session.result({{"folder", folder}, {"report", "report.html"}, {"seconds", session.seconds()}});
    return 0;
}

// Checks the inputs and outputs before work begins.
void require_files(const Options& options) {
    if (input_kind(options.scene) != InputKind::scene)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a scene", options.scene));
    require_folder_name(options.output);
    require_hdf5(std::filesystem::path(options.output) / "lightfield.h5");
    require_picture_name("photo.png");
    require_picture_name("photo.exr");
}

// Returns the request for the scene. Prints changes of the pitch.
MakeRequest resolved_request(const Options& options, const Scene& scene, const Session& session) {
    MakeRequest request = resolve(options.make.request(session.seed), bounds(scene));
    session.say(options.make.hologram.note_about_pitch(request.hologram, request.light_field.grid));
    with_renamed_parameters({{"wavelength", "hogels, size"}}, [&] {
        require_holograms(request.light_field.grids(), request.hologram, cameras_of(request));
    });
    return request;
}

Report begin_report(const Options& options, const Scene& scene, const Session& session) {
    Report report;
    report.scene = options.scene;
    report.triangles = triangle_count(scene);
    report.scene_input = describe_input(options.scene, scene);
    report.work = work_of(session, report.scene_input);
    return report;
}

// Returns the files of the light field and the hologram.
// @param resume  identifies the scene if the work can be resumed
MakeOptions files_in(const std::filesystem::path& folder, const Options& options, const Records& records,
                     const std::optional<std::string>& resume) {
    MakeOptions files;
    files.light_field_file = folder / "lightfield.h5";
    files.light_field.metadata = records.light_field;
    files.light_field.resume = resume;
    if (options.store_hologram) files.hologram_file = folder / "hologram.h5";
    files.hologram.metadata = records.hologram;
    files.hologram.resume = resume;
    return files;
}

// Writes the pictures and the report.
void write_outputs(const std::filesystem::path& folder, const Made& made, const Records& records, Report& report,
                   const Session& session) {
    write_photographs(folder, made, {records.waves, records.speckle_free, records.rays},
                      Progress(session.stop.get_token()));
    report.render_command = render_command(records.light_field);
    report.run = records.report;
    write_text(folder / "report.json", report_json(report, made));
    write_text(folder / "report.html", report_html(report, made, folder));
}

int make(Options& options, const Session& session) {
    require_files(options);
    options.make.fit();
    const Scene scene = load_scene(session, options.scene, options.make.render);
    MakeRequest request = resolved_request(options, scene, session);
    check_plan(request, options, session);

    const std::filesystem::path checkpoint = std::filesystem::path(options.output) / "make";
    const bool resumes = options.resume && std::filesystem::exists(checkpoint.string() + ".part");
    Report report = begin_report(options, scene, session);
    if (options.resume && !resumes && !options.force && has_report_of(options.output, report.work))
        return report_done(session, options.output);
    const OutputFolder folder(options.output, options.force || resumes);
    ResumableOutput resumable(session, options.resume, checkpoint.string(), report.scene_input);
    TemporaryFile light_field_file(folder.path() / "lightfield.h5", options.keep_light_field || options.resume);

    Stages stages(session, report);
    stages.begin("light field");
    const LightField rendered = render_light_field(session, scene, options.make.render);
    require_memory(session, rendered, options.make.render, scene);
    const Records records = records_of(options.make, request, session);
    MakeOptions files =
        files_in(folder.path(), options, records, options.resume ? std::optional(report.scene_input) : std::nullopt);
    files.stage = [&](const std::string& name) { return stages.begin(name); };
    const Made made = hogel::make(rendered, request, files, Progress(session.stop.get_token()));
    stages.end();
    if (!is_root_rank()) return 0;
    if (options.keep_light_field) report.light_field_bytes = std::filesystem::file_size(light_field_file.path());
    write_outputs(folder.path(), made, records, report, session);
    resumable.complete();
    light_field_file.keep(options.keep_light_field);
    session.say("");
    session.say((folder.path() / "report.html").string());
    session.result(result_of(made, report.triangles, options.output, session));
    return 0;
}

}  // namespace

void add_make(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel make pumpkin -o pumpkin\n"
        "  hogel make bunny.ply -o bunny --hogels 128x128 --size 8mm --looks 4");
    command.basics(
        {"hogels", "directions", "size", "fov", "rotate", "light", "pupil", "eye-distance", "resolution", "looks"});
    command.positional("scene", options->scene, "SCENE", "Picture, mesh file or built-in scene").acts_if([options] {
        return options->make.is_one_of({MakeParameters::Output::light_field});
    });
    command.text("-o,--output", options->output, "DIR", "Folder for all outputs").required().never_acts();
    add_force_flag(command, options->force);
    command
        .flag("--store-hologram", options->store_hologram,
              "Store the hologram as hologram.h5; by default it is streamed and never stored")
        .never_acts();
    command
        .flag("--keep-light-field", options->keep_light_field,
              "Keep the light field as lightfield.h5; the report contains the command to render it again")
        .never_acts();
    command
        .flag("--resume", options->resume,
              "Save a checkpoint in DIR when interrupted, and continue from it the next time")
        .never_acts();
    options->make.declare(command);
    command.add_like_option();
    command.work([options, &session] { return make(*options, session); });
}

}  // namespace hogel::cli
