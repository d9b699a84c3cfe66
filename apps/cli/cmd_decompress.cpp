// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/compress.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    bool single = false, half = false;
    std::size_t layers = 0;
};

// All faces tile by tile, for they may come from the same bytes, which are then decoded once.
void copy_together(std::span<const LightField::Source> faces, const std::vector<std::unique_ptr<LightFieldSink>>& sinks,
                   const Progress& progress) {
    const LightFieldGrid& grid = faces.front()->grid();
    const HogelRange size = faces.front()->preferred_tile();
    for (std::size_t t = 0; t < grid.hogels_t; t += size.nt)
        for (std::size_t s = 0; s < grid.hogels_s; s += size.ns) {
            for (std::size_t i = 0; i < faces.size(); ++i) {
                const HogelRange range{s, t, std::min(size.ns, grid.hogels_s - s),
                                       std::min(size.nt, grid.hogels_t - t)};
                LightFieldTile tile(faces[i]->grid(), range, faces[i]->has_depth());
                faces[i]->read(tile);
                sinks[i]->write(tile);
            }
            progress.report(static_cast<double>(t) / static_cast<double>(grid.hogels_t));
        }
    for (const auto& sink : sinks) sink->finish();
}

int decompress_file(const Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field || !is_stream(options.input))
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a compressed light field", options.input));
    require_writable(options.output);
    const LightField light_field = open_stream(options.input, {.layers = options.layers});
    const std::span<const LightField::Source> faces = light_field.faces();
    LightFieldFileOptions file;
    // Who asked for exact samples shall not lose them here.
    const std::string coder = read_stream_info(options.input).method.coder;
    const bool exact = coder == "lossless" || coder == "bounded";
    file.type = options.single || (exact && !options.half) ? SampleType::single : SampleType::half;
    file.metadata = describe_run(session);
    file.with_depth = faces.front()->has_depth();
    std::vector<LightFieldGrid> grids;
    for (const auto& face : faces) grids.push_back(face->grid());
    const auto sinks = create_light_field_faces(options.output, grids, file);
    Stage stage(session, "decompressing");
    if (faces.size() == 1)
        copy(*faces.front(), *sinks.front(), stage.progress());
    else
        copy_together(faces, sinks, stage.progress());
    session.say(fmt::format("{}: {}", options.output,
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    return 0;
}

}  // namespace

void add_decompress(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "decompress", "Decompress a light field",
                                    "  hogel decompress pumpkin.hgl -o pumpkin.h5",
                                    [options, &session] { return decompress_file(*options, session); });
    command->add_option("input", options->input, "Compressed light field")->type_name("X.hgl")->required();
    command->add_option("-o,--output", options->output, "Light field to write, HDF5")->type_name("FILE")->required();
    command
        ->add_option(
            "--layers", options->layers,
            "Decode the first layers alone: coarser, and the rest of the file may be missing\n(hogel info says "
            "how many there are; default: all)")
        ->type_name("N")
        ->check(CLI::PositiveNumber.description(""));
    CLI::Option* single = command->add_flag("--float", options->single, "Store 32-bit floats rather than 16-bit ones");
    command->add_flag("--half", options->half, "Store 16-bit floats even where every bit was kept, or an error kept to")
        ->excludes(single);
}

}  // namespace hogel::cli
