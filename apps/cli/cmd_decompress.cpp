// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    bool single = false, half = false, resume = false;
    std::size_t layers = 0;
};

// Copies all faces tile by tile: faces may share compressed bytes, which are then decoded once.
void copy_faces(const LightField& light_field, const std::vector<std::unique_ptr<LightFieldSink>>& sinks,
                const Progress& progress) {
    const std::span<const LightField::Source> faces = light_field.faces();
    const LightFieldGrid& grid = light_field.grid();
    const HogelRange size = light_field.front().preferred_tile();
    for (std::size_t t = 0; t < grid.hogels_t; t += size.nt)
        for (std::size_t s = 0; s < grid.hogels_s; s += size.ns) {
            for (std::size_t i = 0; i < faces.size(); ++i) {
                const HogelRange range{s, t, std::min(size.ns, grid.hogels_s - s),
                                       std::min(size.nt, grid.hogels_t - t)};
                if (sinks[i]->has_already(range)) continue;
                LightFieldTile tile(faces[i]->grid(), range, faces[i]->has_depth());
                faces[i]->read(tile);
                sinks[i]->write(tile);
            }
            progress.report(static_cast<double>(t) / static_cast<double>(grid.hogels_t));
        }
    for (const auto& sink : sinks) sink->finish();
}

int decompress_file(Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field || !is_stream(options.input))
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a compressed light field", options.input));
    require_writable(options.output, {&options.input, 1});
    require_hdf5(options.output);
    const LightField light_field = open_stream(options.input, {.layers = options.layers});
    LightFieldFileOptions file;
    // Samples of exact coders are not rounded to half floats.
    const std::string coder = read_stream_info(options.input).method.coder;
    const bool exact = coder == "lossless" || coder == "bounded";
    file.type = options.single || (exact && !options.half) ? SampleType::single : SampleType::half;
    options.single = file.type == SampleType::single;
    options.half = !options.single;
    file.metadata = with_history(run_metadata(session), to_metadata(light_field.provenance()));
    file.with_depth = light_field.has_depth();
    if (options.resume) file.resume = describe_input(options.input);
    const auto sinks = create_light_field(options.output, light_field.grids(), file);
    Stage stage(session, "decompressing");
    if (!light_field.has_sides())
        copy(light_field.front(), *sinks.front(), stage.progress());
    else
        copy_faces(light_field, sinks, stage.progress());
    session.say(fmt::format("{}: {}", options.output,
                            format_bytes(static_cast<double>(std::filesystem::file_size(options.output)))));
    report_samples(session, options.output);
    return 0;
}

}  // namespace

void add_decompress(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples("  hogel decompress pumpkin.hgl -o pumpkin.h5");
    command.positional("input", options->input, "X.hgl", "Compressed light field");
    command.text("-o,--output", options->output, "FILE", "Light field to write, HDF5").required().never_acts();
    command
        .count("--layers", options->layers,
               "Decode only the first layers: coarser, and the rest of the file may be missing (hogel info prints "
               "their number; default: all)")
        .no_default();
    const Parameter& single =
        command.flag("--float", options->single, "Store 32-bit floats rather than 16-bit ones").acts_if([options] {
            return options->single;
        });
    command.flag("--half", options->half, "Store 16-bit floats even if the coding is lossless or has a bounded error")
        .excludes(single)
        .acts_if([options] { return options->half; });
    add_resume_flag(command, options->resume);
    command.add_like_option();
    command.work([options, &session] { return decompress_file(*options, session); });
}

}  // namespace hogel::cli
