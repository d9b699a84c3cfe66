// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "hogel/units.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string output;
    CamerasParameters cameras;
};

int cameras(const Options& options, const Session& session) {
    if (std::filesystem::path(options.output).extension() != ".json")
        throw Error(ErrorCode::usage, fmt::format("{}: cameras are written as .json", options.output));
    require_writable(options.output, {});
    const LightFieldGrid grid = options.cameras.grid();
    const std::vector<std::string> notes =
        with_parameter("hogels, directions, size", [&] { return write_cameras(grid, options.output); });
    const double spacing = grid.step_u() * options.cameras.distance;
    session.say(
        fmt::format("{}: {}x{} cameras {} apart at {}, with axes parallel and pictures of {}x{} pixels that "
                    "agree on the hologram; render them beside it as 000_000.png and so on, and import the folder",
                    options.output, grid.directions_u, grid.directions_v, format_length(spacing),
                    format_length(options.cameras.distance), grid.hogels_s, grid.hogels_t));
    for (const std::string& note : notes) session.say(fmt::format("{}: {}", options.output, note));
    session.result({{"file", options.output},
                    {"bytes", std::filesystem::file_size(options.output)},
                    {"views_across", grid.directions_u},
                    {"views_down", grid.directions_v},
                    {"camera_spacing_m", spacing},
                    {"camera_distance_m", options.cameras.distance},
                    {"seconds", session.seconds()}});
    return 0;
}

}  // namespace

void add_cameras(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel cameras -o transforms.json --size 40mm --hogels 512x512 --directions 9x9 --fov 16deg\n"
        "  hogel cameras -o walk/transforms.json --size 2m --distance 10m --hogels 800x600 --directions 45x1");
    command
        .text("-o,--output", options->output, "FILE", "transforms.json to write, as nerfstudio and instant-ngp read it")
        .required()
        .never_acts();
    options->cameras.declare(command);
    command.work([options, &session] { return cameras(*options, session); });
}

}  // namespace hogel::cli
