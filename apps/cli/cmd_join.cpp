// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "hogel/files.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::vector<std::string> parts;
    std::string output;
};

int join(const Options& options, const Session& session) {
    require_writable(options.output, options.parts);
    require_hdf5(options.output);
    {
        Stage stage(session, "joining");
        const std::vector<std::filesystem::path> parts(options.parts.begin(), options.parts.end());
        join_parts(options.output, parts, stage.progress());
    }
    session.say(fmt::format("{}: {} parts, {}", options.output, options.parts.size(),
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    report_samples(session, options.output);
    return 0;
}

}  // namespace

void add_join(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel render pumpkin -o pumpkin.h5 --part 1/2\n"
        "  hogel render pumpkin -o pumpkin.h5 --part 2/2\n"
        "  hogel join pumpkin.part-1-of-2 pumpkin.part-2-of-2 -o pumpkin.h5");
    command.positionals("parts", options->parts, "PART",
                        "Files written by 'hogel render' or 'hogel hologram' with --part");
    command.text("-o,--output", options->output, "FILE", "Light field or hologram to write, HDF5")
        .required()
        .never_acts();
    command.work([options, &session] { return join(*options, session); });
}

}  // namespace hogel::cli
