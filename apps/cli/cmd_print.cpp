// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/core/parallel.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output, order = "serpentine";
    bool strips = false, force = false;
    double exposure = 1;
};

// The directions of one hogel as a picture, put into another at a column.
void paste(const LightFieldTile& tile, std::size_t hogel, Image& picture, std::size_t column) {
    const auto& radiance = tile.radiance;
    for (std::size_t c = 0; c < radiance.extent(0); ++c)
        for (std::size_t v = 0; v < radiance.extent(3); ++v)
            for (std::size_t u = 0; u < radiance.extent(4); ++u)
                picture.pixels(v, column + u, c) = radiance(c, 0, hogel, v, u);
}

// Hogels of one row in the order in which they are printed: a head that runs back and forth takes every second row from
// the right.
std::size_t place_in_row(std::size_t i, std::size_t row, std::size_t hogels, bool serpentine) {
    return serpentine && row % 2 == 1 ? hogels - 1 - i : i;
}

int print(const Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    if (!(options.exposure > 0)) throw Error(ErrorCode::usage, "--exposure: a positive number was expected");
    const auto light_field = open_light_field(options.input);
    const LightFieldGrid& grid = light_field->grid();
    const OutputFolder folder(options.output, options.force);
    const bool serpentine = options.order == "serpentine";
    const std::size_t pictures = options.strips ? grid.hogels_t : grid.hogels();
    const std::size_t digits = std::to_string(pictures).size();
    const auto name = [&](std::size_t number) {
        return folder.path() / fmt::format("{}_{:0{}}.png", options.strips ? "strip" : "hogel", number, digits);
    };
    Stage stage(session, "pictures");
    const Progress progress = stage.progress();
    for (std::size_t t = 0; t < grid.hogels_t; ++t) {
        progress.report(static_cast<double>(t) / static_cast<double>(grid.hogels_t));
        LightFieldTile tile(grid, {0, t, grid.hogels_s, 1}, false);
        light_field->read(tile);
        if (options.strips) {
            Image strip(grid.hogels_s * grid.directions_u, grid.directions_v, grid.channels);
            for (std::size_t i = 0; i < grid.hogels_s; ++i)
                paste(tile, place_in_row(i, t, grid.hogels_s, serpentine), strip, i * grid.directions_u);
            write_image(name(t + 1), strip, options.exposure, describe_run(session));
        } else {
            core::parallel_for(grid.hogels_s, [&](std::size_t i) {
                Image hogel(grid.directions_u, grid.directions_v, grid.channels);
                paste(tile, place_in_row(i, t, grid.hogels_s, serpentine), hogel, 0);
                write_image(name(t * grid.hogels_s + i + 1), hogel, options.exposure);
            });
        }
    }
    session.say(fmt::format("{}: {} pictures, {} to {}", options.output, pictures, name(1).filename().string(),
                            name(pictures).filename().string()));
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
        .required();
    add_force_flag(command, options->force);
    command.flag("--strips", options->strips, "One picture a row of hogels, side by side, instead of one a hogel");
    command.choice("--order", options->order, {"serpentine", "rows"}, "NAME",
                   "serpentine: every second row from the right\nrows: all rows from the left");
    command.number("--exposure", options->exposure, "NUMBER",
                   "What linear values are multiplied by, the same in all pictures");
    command.work([options, &session] { return print(*options, session); });
}

}  // namespace hogel::cli
