// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
    std::string hemicube = "faces", table, tone = "none", symbols, rule = "search";
    std::optional<double> overhead;
    double tone_decades = defaults.tone_decades;
    Counts tile;
    bool no_depth = false, resume = false;
    double depth_error = 0;

    // What decides which options act.
    bool has_table = false, is_three_pass = false, has_sides = false, has_depth = false;
    /// What bounds the error of every sample takes no mapping.
    bool is_mapped() const { return !max_error && !lossless; }
};

const std::map<std::string, QuantisationTable> tables{{"jpeg", QuantisationTable::jpeg},
                                                      {"own", QuantisationTable::own}};
const std::map<std::string, ZerotreeSymbols> symbol_codings{{"alphabets", ZerotreeSymbols::alphabets},
                                                            {"bits", ZerotreeSymbols::bits}};
const std::map<std::string, RateRule> rules{
    {"histogram", RateRule::histogram}, {"planes", RateRule::planes}, {"search", RateRule::search}};
const std::vector<std::string> tones{"none", "histogram"};
const std::vector<std::string> layouts{"faces", "unfolded"};

CompressionTarget target_of(const Options& options) {
    if (options.pixels_per_bit) return PixelsPerBit{*options.pixels_per_bit, rules.at(options.rule), options.overhead};
    if (options.step) return Step{*options.step};
    if (options.max_error) return MaxError{*options.max_error};
    if (options.lossless) return Lossless{};
    return Sqnr{options.sqnr.value_or(defaults.sqnr)};
}

// Throws Error(usage) for names that do not exist.
void check_method(const CodingMethod& method) {
    coders().find(method.coder);
    const std::vector<std::string> known = transform_names();
    if (!method.transform.empty() && !std::ranges::count(known, method.transform))
        throw_unknown("transform", method.transform, known, "transform");
}

// Throws Error(usage) for options of the three-pass coder that do not act.
void check_zerotrees(const Options& options) {
    const std::string& coder = options.compression.method.coder;
    const bool three_pass = coders().find(coder).three_pass;
    if (!three_pass && !options.symbols.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("--symbols: coder {} has no zerotrees of three passes; threepass and fringes have them",
                                coder));
    if (!three_pass && options.rule != "search")
        throw Error(ErrorCode::usage,
                    fmt::format("--rule: coder {} finds a rate by search; threepass and fringes have rules", coder));
    if (options.overhead && options.rule == "search")
        throw Error(ErrorCode::usage, "--overhead: goes with --rule histogram or planes");
}

// Sets the values that act on this light field where they are not given, and what decides which act.
void resolve(Options& options, const LightField& light_field) {
    CodingMethod& method = options.compression.method;
    const CoderInfo& coder = coders().find(method.coder);
    if (const auto* target = std::get_if<Sqnr>(&options.compression.target)) options.sqnr = target->decibels;
    if (method.transform.empty()) method.transform = coder.transform;
    options.has_table = coder.quantisation_table;
    if (options.has_table && options.table.empty()) options.table = "own";
    options.is_three_pass = coder.three_pass;
    if (options.is_three_pass && options.symbols.empty()) options.symbols = "bits";
    if (options.pixels_per_bit && options.rule != "search" && !options.overhead)
        options.overhead = default_overhead(method.symbols);
    options.has_sides = light_field.has_sides();
    options.has_depth = light_field.has_depth();
}

int compress_file(Options& options, const Session& session) {
    if (input_kind(options.input) != InputKind::light_field)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is not a light field", options.input));
    const LightField light_field = open_light_field_or_views(options.input);
    require_writable(options.output, {&options.input, 1});
    require_name(options.output, "hgl");
    CompressionOptions& compression = options.compression;
    compression.target = target_of(options);
    if (options.tile.columns > 0) compression.tile = HogelRange{0, 0, options.tile.columns, options.tile.rows};
    check_method(compression.method);
    if (!options.table.empty()) {
        if (!coders().find(compression.method.coder).quantisation_table)
            throw Error(ErrorCode::usage, fmt::format("--table: coder {} has no quantisation table; jpeg4d has one",
                                                      compression.method.coder));
        compression.method.table = tables.at(options.table);
    }
    check_zerotrees(options);
    if (!options.symbols.empty()) compression.method.symbols = symbol_codings.at(options.symbols);
    if (options.hemicube == "unfolded") compression.layout = StreamLayout::unfolded;
    if (options.tone == "histogram") compression.tone_decades = options.tone_decades;
    compression.with_depth = light_field.has_depth() && !options.no_depth;
    if (options.depth_error > 0) compression.depth_error = options.depth_error;
    if (compression.depth_error && !compression.with_depth)
        throw Error(ErrorCode::usage, fmt::format("--depth-error: {} has no depth to keep", options.input));
    resolve(options, light_field);
    compression.metadata = run_metadata(session);
    Kept kept(session, options.resume, options.output, options.resume ? describe_input(options.input) : "");
    Stage stage(session, "compressing");
    const auto work = [&] {
        state_plan(session, plan_compression(light_field, compression), "compressing", options.output);
        return compress(light_field, options.output, compression, stage.progress());
    };
    const CompressionResult result = kept.unless_refused(work);
    kept.complete();
    report_compressed(session, options.output, result);
    return 0;
}

// The targets, which exclude each other.
void add_target_options(Command& command, Options& options) {
    const Parameter& sqnr = command.number(
        "--sqnr", options.sqnr, "DB", fmt::format("Signal to error, within 0.1 dB above (default: {})", defaults.sqnr));
    const Parameter& ppb =
        command.number("--ppb", options.pixels_per_bit, "N", "Size, to the byte: rays, with all their colours, a bit")
            .positive()
            .excludes(sqnr);
    const Parameter& rule =
        command
            .choice("--rule", options.rule, {"search", "histogram", "planes"}, "search|histogram|planes",
                    "How --ppb finds the step of threepass and fringes: by search, to the byte; once "
                    "from a histogram of coefficients, about; so too, with whole bit planes as in "
                    "Kartch's thesis")
            .needs(ppb)
            .acts_if([&options] { return options.pixels_per_bit && options.is_three_pass; });
    command
        .number("--overhead", options.overhead, "C",
                fmt::format("Bits for the trees that the rule counts for each coefficient that is not 0 (0 to 32; "
                            "default: {}, or {} with --symbols alphabets)",
                            default_overhead(ZerotreeSymbols::bits), default_overhead(ZerotreeSymbols::alphabets)))
        .range(0, 32)
        .needs(rule);
    const Parameter& step = command.number("--step", options.step, "N", "The quantiser's step, in units of radiance")
                                .positive()
                                .excludes(sqnr)
                                .excludes(ppb);
    const Parameter& max_error =
        command.number("--max-error", options.max_error, "E", "Every sample within this of what it was, in radiance")
            .positive()
            .excludes(sqnr)
            .excludes(ppb)
            .excludes(step);
    command.flag("--lossless", options.lossless, "Every bit of every sample and every depth as it was")
        .excludes(sqnr)
        .excludes(ppb)
        .excludes(step)
        .excludes(max_error)
        .acts_if([&options] { return options.lossless; });
}

void add_method_options(Command& command, Options& options) {
    CodingMethod& method = options.compression.method;
    command.text("--coder", method.coder, "NAME", fmt::format("{}", fmt::join(coders().names(), ", ")));
    command
        .text("--transform", method.transform, "NAME",
              fmt::format("{}\nNot for hogel; otherwise cdf97, or dct8 for jpeg4d", fmt::join(transform_names(), ", ")))
        .acts_if([&options] { return !coders().find(options.compression.method.coder).transform.empty(); });
    command
        .choice("--table", options.table, {"jpeg", "own"}, "jpeg|own",
                "Quantisation table of jpeg4d: JPEG's, or one optimised for the light field (default: own)")
        .acts_if([&options] { return options.has_table; });
    command
        .choice("--symbols", options.symbols, {"bits", "alphabets"}, "bits|alphabets",
                "How threepass and fringes code zerotrees: bit by bit, or from the alphabets of Kartch's thesis "
                "(default: bits)")
        .acts_if([&options] { return options.is_three_pass; });
    command
        .choice("--hemicube", options.hemicube, layouts, "faces|unfolded",
                "How a hemicube is coded: its faces one by one, or unfolded into one array with smooth corners")
        .acts_if([&options] { return options.has_sides; });
    const Parameter& no_depth =
        command.flag("--no-depth", options.no_depth, "Leave the depth of the rays out").acts_if([&options] {
            return options.has_depth;
        });
    command
        .positive_length("--depth-error", options.depth_error,
                         "The depth of every ray within this of what it was (default: the pitch of the hogels over "
                         "32,000 times the tangent of the steepest ray, and no more than a 1,000th of the range of "
                         "depths; exact with --lossless)")
        .no_default()
        .excludes(no_depth)
        .acts_if([&options] { return options.compression.with_depth; });
}

// Mappings that put errors where the eye is less sensitive.
void add_mapping_options(Command& command, Options& options) {
    const Parameter& tone =
        command
            .choice("--tone", options.tone, tones, "none|histogram",
                    "Code the light field along a curve of its luminance, made of its histogram, which is undone "
                    "when it is read: for high ranges, to keep what the eye sees. --sqnr and --step then speak of "
                    "the light field along the curve")
            .acts_if([&options] { return options.is_mapped(); });
    command
        .number("--tone-decades", options.tone_decades, "N",
                "Decades of luminance that the curve leaves (0.1 to 20); what spans no more has none")
        .range(0.1, 20)
        .needs(tone)
        .acts_if([&options] { return options.compression.tone_decades.has_value(); });
    command
        .number("--chrominance", options.compression.chrominance, "F",
                "Code the two channels of chrominance so many times as coarsely as luminance (1 to 1024); --sqnr "
                "and --step then speak of colours whose chrominance is divided by it")
        .range(1, 1024)
        .acts_if([&options] { return options.is_mapped(); });
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
    add_target_options(command, *options);
    add_method_options(command, *options);
    add_mapping_options(command, *options);
    command.counts("--tile", options->tile, "Hogels across and down that are coded together; 0: as suits").no_default();
    command.add_like_option();
    command.work([options, &session] { return compress_file(*options, session); });
}

}  // namespace hogel::cli
