// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output, order = "serpentine";
    bool strips = false;
    double exposure = 1;
};

int print(const Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    if (!(options.exposure > 0)) throw Error(ErrorCode::usage, "--exposure: a positive number was expected");
    const LightField light_field = open_light_field(options.input);
    const OutputFolder folder(options.output);
    Stage stage(session, "pictures");
    const auto names = write_printer_images(folder.path(), light_field,
                                            {.rows = options.strips,
                                             .serpentine = options.order == "serpentine",
                                             .exposure = options.exposure,
                                             .provenance = describe_run(session)},
                                            stage.progress());
    session.say(fmt::format("{}: {} pictures, {} to {}", options.output, names.size(),
                            names.front().filename().string(), names.back().filename().string()));
    return 0;
}

}  // namespace

void add_print(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "print", "Write a light field as pictures for a hologram printer",
                                    "  hogel print pumpkin.h5 -o hogels\n"
                                    "  hogel print pumpkin.h5 -o strips --strips --order rows",
                                    [options, &session] { return print(*options, session); });
    command->add_option("input", options->input, "Light field")->type_name("X.h5")->required();
    command->add_option("-o,--output", options->output, "Folder for the pictures, numbered in the order of printing")
        ->type_name("FOLDER")
        ->required();
    command->add_flag("--strips", options->strips, "One picture a row of hogels, side by side, instead of one a hogel");
    command
        ->add_option("--order", options->order,
                     "serpentine: every second row from the right\nrows: all rows from the left")
        ->type_name("NAME")
        ->check(CLI::IsMember({"serpentine", "rows"}).description(""))
        ->capture_default_str();
    command
        ->add_option("--exposure", options->exposure, "What linear values are multiplied by, the same in all pictures")
        ->type_name("NUMBER")
        ->capture_default_str();
}

}  // namespace hogel::cli
