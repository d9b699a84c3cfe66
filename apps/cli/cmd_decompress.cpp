#include <fmt/format.h>

#include "commands.h"
#include "hogel/codec/stream.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    bool single = false;
};

int decompress_file(const Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field || !is_stream(options.input))
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a compressed light field", options.input));
    require_writable(options.output);
    const auto source = open_stream(options.input);
    LightFieldFileOptions file;
    file.type = options.single ? SampleType::single : SampleType::half;
    file.metadata = describe_run(session);
    const auto sink = create_light_field(options.output, source->grid(), file);
    Stage stage(session, "decompressing");
    copy(*source, *sink, stage.progress());
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
    command->add_flag("--float", options->single, "Store 32-bit floats rather than 16-bit ones");
}

}  // namespace hogel::cli
