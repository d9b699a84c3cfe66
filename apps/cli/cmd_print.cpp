// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    PrintParameters images;
    bool force = false;
};

int print(const Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    const LightField light_field = open_light_field_or_views(options.input);
    const OutputFolder folder(options.output, options.force);
    Stage stage(session, "pictures");
    PrinterImageOptions images = options.images.options();
    images.metadata = run_metadata(session);
    const auto names = write_printer_images(folder.path(), light_field, images, stage.progress());
    session.say(fmt::format("{}: {} pictures, {} to {}", options.output, names.size(),
                            names.front().filename().string(), names.back().filename().string()));
    std::uintmax_t bytes = 0;
    for (const auto& name : names) bytes += std::filesystem::file_size(name);
    session.result({{"folder", options.output},
                    {"bytes", bytes},
                    {"pictures", names.size()},
                    {"first", names.front().filename().string()},
                    {"last", names.back().filename().string()},
                    {"exposure", images.exposure},
                    {"seconds", session.seconds()}});
    return 0;
}

}  // namespace

void add_print(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel print pumpkin.h5 -o hogels\n"
        "  hogel print pumpkin.h5 -o strips --strips --order rows");
    command.positional("input", options->input, "X.h5", "Light field");
    command.text("-o,--output", options->output, "FOLDER", "Folder for the pictures, numbered in the order of printing")
        .required()
        .never_acts();
    add_force_flag(command, options->force);
    options->images.declare(command);
    command.add_like_option();
    command.work([options, &session] { return print(*options, session); });
}

}  // namespace hogel::cli
