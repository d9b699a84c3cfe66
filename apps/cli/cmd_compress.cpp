// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/compress.h"
#include "hogel/requests.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    CompressionParameters compression;
    bool resume = false;
};

int compress_file(Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    const LightField light_field = open_light_field_or_views(options.input);
    require_writable(options.output, {&options.input, 1});
    require_name(options.output, "hgl");
    CompressionOptions compression = options.compression.options(light_field);
    options.compression.resolve(light_field);
    compression.metadata = run_metadata(session);
    ResumableOutput resumable(session, options.resume, options.output,
                              options.resume ? describe_input(options.input) : "");
    Stage stage(session, "compressing");
    const auto work = [&] {
        check_plan(session, plan_compression(light_field, compression), "compressing", options.output);
        return compress(light_field, options.output, compression, stage.progress());
    };
    const CompressionResult result = resumable.unless_refused(work);
    resumable.complete();
    report_compressed(session, options.output, result);
    return 0;
}

}  // namespace

void add_compress(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel compress pumpkin.h5 -o pumpkin.hgl\n"
        "  hogel compress pumpkin.h5 -o small.hgl --ppb 20\n"
        "  hogel compress pumpkin.h5 -o exact.hgl --lossless\n"
        "  hogel compress pumpkin.h5 -o k.hgl --coder ezw --transform ai33 --sqnr 30");
    command.basics({"sqnr", "ppb", "max-error", "lossless", "coder", "no-depth", "depth-error", "tone", "resume"});
    command.positional("input", options->input, "X.h5|X.hgl", "Light field");
    command.text("-o,--output", options->output, "FILE.hgl", "Compressed light field to write").required().never_acts();
    add_resume_flag(command, options->resume);
    options->compression.declare(command);
    command.add_like_option();
    command.work([options, &session] { return compress_file(*options, session); });
}

}  // namespace hogel::cli
