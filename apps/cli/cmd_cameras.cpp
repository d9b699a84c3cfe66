// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "commands.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string output;
    Counts hogels{defaults.hogels, defaults.hogels};
    Counts directions{9, 9};
    double size = defaults.size, distance = 0.3;
    Angles field_of_view{defaults.field_of_view, defaults.field_of_view};
};

int cameras(const Options& options, const Session& session) {
    if (std::filesystem::path(options.output).extension() != ".json")
        throw Error(ErrorCode::usage, fmt::format("{}: cameras are written as .json", options.output));
    require_writable(options.output, {});
    LightFieldGrid grid;
    grid.hogels_s = options.hogels.columns;
    grid.hogels_t = options.hogels.rows;
    grid.pitch = options.size / static_cast<double>(options.hogels.columns);
    grid.directions_u = options.directions.columns;
    grid.directions_v = options.directions.rows;
    const Perspective range = field_of_view(options.field_of_view.across, options.field_of_view.down);
    grid.view = FocalPlane{range, -options.distance};
    const std::vector<std::string> notes =
        with_parameter("hogels, directions, size", [&] { return write_cameras(grid, options.output); });
    const double spacing = grid.step_u() * options.distance;
    session.say(
        fmt::format("{}: {}x{} cameras {} apart at {}, with axes parallel and pictures of {}x{} pixels that "
                    "agree on the hologram; render them beside it as 000_000.png and so on, and import the folder",
                    options.output, grid.directions_u, grid.directions_v, format_length(spacing),
                    format_length(options.distance), grid.hogels_s, grid.hogels_t));
    for (const std::string& note : notes) session.say(fmt::format("{}: {}", options.output, note));
    session.result({{"file", options.output},
                    {"bytes", std::filesystem::file_size(options.output)},
                    {"views_across", grid.directions_u},
                    {"views_down", grid.directions_v},
                    {"camera_spacing_m", spacing},
                    {"camera_distance_m", options.distance},
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
    command.positive_length("--size", options->size,
                            "Width of the hologram in the scene that is to be rendered; import scales it");
    command.counts("--hogels", options->hogels, "Columns and rows of hogels, the pixels of each picture");
    command.counts("--directions", options->directions, "Columns and rows of cameras");
    command.angles("--fov", options->field_of_view,
                   "Full angles that rows and columns of cameras span from the hologram");
    command.positive_length("--distance", options->distance, "From the cameras to the hologram")
        .sets_parameter("focal_plane");
    command.work([options, &session] { return cameras(*options, session); });
}

}  // namespace hogel::cli
