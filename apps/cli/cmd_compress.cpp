// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <optional>

#include "commands.h"
#include "hogel/compress.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {

namespace {

struct Options {
    std::string input, output;
    CompressionOptions compression;
    std::optional<double> sqnr, pixels_per_bit, step, max_error;
    bool lossless = false;
    std::string hemicube = "faces", table, tone = "none";
    double tone_decades = defaults.tone_decades;
    Counts tile;
    bool no_depth = false;
};

const std::map<std::string, QuantisationTable> tables{{"jpeg", QuantisationTable::jpeg},
                                                      {"own", QuantisationTable::own}};
const std::vector<std::string> tones{"none", "histogram"};
const std::vector<std::string> layouts{"faces", "unfolded"};

CompressionTarget target_of(const Options& options) {
    if (options.pixels_per_bit) return PixelsPerBit{*options.pixels_per_bit};
    if (options.step) return Step{*options.step};
    if (options.max_error) return MaxError{*options.max_error};
    if (options.lossless) return Lossless{};
    return Sqnr{options.sqnr.value_or(defaults.sqnr)};
}

int compress_file(Options options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    const std::vector<std::unique_ptr<LightFieldSource>> sources = open_light_field_faces(options.input);
    std::vector<const LightFieldSource*> faces;
    for (const auto& source : sources) faces.push_back(source.get());
    require_writable(options.output);
    CompressionOptions& compression = options.compression;
    compression.target = target_of(options);
    if (options.tile.columns > 0) compression.tile = HogelRange{0, 0, options.tile.columns, options.tile.rows};
    if (!options.table.empty()) {
        if (!coders().find(compression.method.coder).quantisation_table)
            throw Error(ErrorCode::usage, fmt::format("coder {} has no quantisation table; --table goes with jpeg4d",
                                                      compression.method.coder));
        compression.method.table = tables.at(options.table);
    }
    compression.metadata = describe_run(session);
    if (options.hemicube == "unfolded") compression.layout = StreamLayout::unfolded;
    if (options.tone == "histogram") compression.tone_decades = options.tone_decades;
    compression.with_depth = faces.front()->has_depth() && !options.no_depth;
    if (compression.depth_error > 0 && !compression.with_depth)
        throw Error(ErrorCode::usage, fmt::format("--depth-error: {} has no depth to keep", options.input));
    Stage stage(session, "compressing");
    const CompressionResult result = compress(borrow(faces), options.output, compression, stage.progress());
    say_what_was_compressed(session, options.output, result);
    return 0;
}

}  // namespace

void add_compress(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "compress", "Compress a light field",
                                    "  hogel compress pumpkin.h5 -o pumpkin.hgl\n"
                                    "  hogel compress pumpkin.h5 -o small.hgl --ppb 20\n"
                                    "  hogel compress pumpkin.h5 -o exact.hgl --lossless\n"
                                    "  hogel compress pumpkin.h5 -o k.hgl --coder ezw --transform ai33 --sqnr 30",
                                    [options, &session] { return compress_file(*options, session); });
    CodingMethod& method = options->compression.method;
    command->add_option("input", options->input, "Light field")->type_name("X.h5|X.hgl")->required();
    command->add_option("-o,--output", options->output, "Compressed light field to write")
        ->type_name("FILE.hgl")
        ->required();
    CLI::Option* sqnr =
        command
            ->add_option("--sqnr", options->sqnr,
                         fmt::format("Signal to error, within 0.1 dB above (default: {})", defaults.sqnr))
            ->type_name("DB");
    CLI::Option* ppb =
        command->add_option("--ppb", options->pixels_per_bit, "Size, to the byte: rays, with all their colours, a bit")
            ->type_name("N")
            ->excludes(sqnr);
    CLI::Option* step = command->add_option("--step", options->step, "The quantiser's step, in units of radiance")
                            ->type_name("N")
                            ->excludes(sqnr)
                            ->excludes(ppb);
    CLI::Option* max_error =
        command->add_option("--max-error", options->max_error, "Every sample within this of what it was, in radiance")
            ->type_name("E")
            ->excludes(sqnr)
            ->excludes(ppb)
            ->excludes(step);
    command->add_flag("--lossless", options->lossless, "Every bit of every sample as it was")
        ->excludes(sqnr)
        ->excludes(ppb)
        ->excludes(step)
        ->excludes(max_error);
    command->add_option("--coder", method.coder, fmt::format("{}", fmt::join(coders().names(), ", ")))
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option(
            "--transform", method.transform,
            fmt::format("{}\nNot for hogel; otherwise cdf97, or dct8 for jpeg4d", fmt::join(transform_names(), ", ")))
        ->type_name("NAME");
    command
        ->add_option("--table", options->table,
                     "Quantisation table of jpeg4d: JPEG's, or one optimised for the light field (default: own)")
        ->type_name("jpeg|own")
        ->check(CLI::IsMember(tables).description(""));
    command
        ->add_option("--hemicube", options->hemicube,
                     "How a hemicube is coded: its faces one by one, or unfolded into one array with smooth corners")
        ->type_name("faces|unfolded")
        ->check(CLI::IsMember(layouts).description(""))
        ->capture_default_str();
    CLI::Option* no_depth = command->add_flag("--no-depth", options->no_depth, "Leave the depth of the rays out");
    add_length(command, "--depth-error", options->compression.depth_error,
               "The depth of every ray within this of what it was (default: a 1,000th of the range)")
        ->default_str("")
        ->excludes(no_depth);
    CLI::Option* tone =
        command
            ->add_option(
                "--tone", options->tone,
                "Code the light field along a curve of its luminance, made of its histogram, which is undone\n"
                "when it is read: for high ranges, to keep what the eye sees. --sqnr and --step then speak of\n"
                "the light field along the curve")
            ->type_name("none|histogram")
            ->check(CLI::IsMember(tones).description(""))
            ->capture_default_str();
    command
        ->add_option("--tone-decades", options->tone_decades,
                     "Decades of luminance that the curve leaves (0.1 to 20); what spans no more has none")
        ->type_name("N")
        ->needs(tone)
        ->capture_default_str();
    command
        ->add_option("--chrominance", options->compression.chrominance,
                     "Code the two channels of chrominance so many times as coarsely as luminance (1 to 1024); --sqnr\n"
                     "and --step then speak of colours whose chrominance is divided by it")
        ->type_name("F")
        ->capture_default_str();
    add_counts(command, "--tile", options->tile, "Hogels across and down that are coded together; 0: as suits")
        ->default_str("");
}

}  // namespace hogel::cli
