// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    PrintParameters images;
    LightFieldParameters render;
    bool force = false, resume = false;
};

void report(const Session& session, const std::string& output, const PrinterImages& made) {
    const auto name = [&](const std::filesystem::path& file) { return file.lexically_relative(output).string(); };
    session.say(fmt::format("{}: {} pictures, {} to {}, exposure {:.6g}", output, made.pictures, name(made.first),
                            name(made.last), made.exposure));
    if (made.clipped > 0)
        session.say(fmt::format("{}: {} of {} samples are brighter than white ({:.2g} %)", output, made.clipped,
                                made.samples,
                                100 * static_cast<double>(made.clipped) / static_cast<double>(made.samples)));
    session.result({{"folder", output},
                    {"bytes", made.bytes},
                    {"pictures", made.pictures},
                    {"first", name(made.first)},
                    {"last", name(made.last)},
                    {"exposure", made.exposure},
                    {"samples", made.samples},
                    {"clipped", made.clipped},
                    {"seconds", session.seconds()}});
}

int print(Options& options, const Session& session) {
    if (input_kind(options.input) == InputKind::hologram)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is neither a light field nor a scene", options.input));
    PrinterImageOptions images = options.images.options();
    const LightField light_field = open_or_render(session, options.input, options.render);
    const std::filesystem::path checkpoint = std::filesystem::path(options.output) / "print";
    const bool resumes = options.resume && std::filesystem::exists(checkpoint.string() + ".part");
    const OutputFolder folder(options.output, options.force || resumes);
    ResumableOutput resumable(session, options.resume, checkpoint.string(), describe_input(options.input));
    Stage stage(session, "pictures");
    images.metadata = run_metadata(session);
    const PrinterImages made = resumable.unless_refused(
        [&] { return write_printer_images(folder.path(), light_field, images, stage.progress()); });
    resumable.complete();
    report(session, options.output, made);
    return 0;
}

}  // namespace

void add_print(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel print pumpkin.h5 -o hogels\n"
        "  hogel print pumpkin.h5 -o strips --strips --order rows\n"
        "  hogel print pumpkin -o plate --hogels 100x80 --size 100mm --fov 60deg --mask circle");
    command.positional("input", options->input, "X.h5|X.hgl|SCENE", "Light field, mesh file or built-in scene");
    command.text("-o,--output", options->output, "FOLDER", "Folder for the pictures, numbered in the order of printing")
        .required()
        .never_acts();
    add_force_flag(command, options->force);
    command
        .flag("--resume", options->resume,
              "Save a checkpoint in FOLDER when interrupted, and continue from it the next time")
        .never_acts();
    command.basics({"strips", "order", "mirror", "mask", "exposure", "dose", "planes", "bits"});
    options->images.declare(command);
    options->render.declare(command);
    options->render.declare_focal_plane(command);
    command.add_like_option();
    command.work([options, &session] { return print(*options, session); });
}

}  // namespace hogel::cli
