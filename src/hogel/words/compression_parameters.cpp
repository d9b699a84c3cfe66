// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "hogel/compress.h"
#include "hogel/error.h"
#include "hogel/requests.h"
#include "hogel/table.h"

namespace hogel {
namespace {

const std::map<std::string, QuantisationTable> quantisation_tables{{"jpeg", QuantisationTable::jpeg},
                                                                   {"own", QuantisationTable::own}};
const std::map<std::string, ZerotreeSymbols> symbol_codings{{"alphabets", ZerotreeSymbols::alphabets},
                                                            {"bits", ZerotreeSymbols::bits}};
const std::map<std::string, RateRule> rate_rules{
    {"histogram", RateRule::histogram}, {"planes", RateRule::planes}, {"search", RateRule::search}};

CompressionTarget target_of(const CompressionParameters& asked) {
    if (asked.pixels_per_bit) return PixelsPerBit{*asked.pixels_per_bit, rate_rules.at(asked.rule), asked.overhead};
    if (asked.step) return Step{*asked.step};
    if (asked.max_error) return MaxError{*asked.max_error};
    if (asked.lossless) return Lossless{};
    return Sqnr{asked.sqnr.value_or(defaults.sqnr)};
}

// Throws Error(usage) for unknown names, and for parameters that the coder does not support.
CodingMethod method_of(const CompressionParameters& asked) {
    CodingMethod method = asked.compression.method;
    const CoderInfo& coder = coders().find(method.coder);
    const std::vector<std::string> known = transform_names();
    if (!method.transform.empty() && !std::ranges::count(known, method.transform))
        throw_unknown("transform", method.transform, known, "transform");
    const auto refuse = [&](const char* parameter, const char* why) {
        throw Error(ErrorCode::usage, parameter, fmt::format("coder {} {}", method.coder, why));
    };
    if (!coder.quantisation_table && !asked.table.empty()) refuse("table", "has no quantisation table; jpeg4d has one");
    if (!coder.three_pass && !asked.symbols.empty())
        refuse("symbols", "has no three-pass zerotrees; threepass and fringes have them");
    if (!coder.three_pass && asked.rule != "search")
        refuse("rule", "supports only the rule search; threepass and fringes support others");
    if (!asked.table.empty()) method.table = quantisation_tables.at(asked.table);
    if (!asked.symbols.empty()) method.symbols = symbol_codings.at(asked.symbols);
    return method;
}

// Declares the targets; they exclude each other.
void declare_targets(Parameters& parameters, CompressionParameters& asked) {
    const Parameter& sqnr = parameters.number(
        "--sqnr", asked.sqnr, "DB",
        fmt::format("Signal-to-quantisation-noise ratio, met within 0.1 dB above (default: {})", defaults.sqnr));
    const Parameter& ppb = parameters
                               .number("--ppb", asked.pixels_per_bit, "N",
                                       "Size, met to the byte: rays per bit, where a ray has all its colours")
                               .positive()
                               .excludes(sqnr);
    const Parameter& rule =
        parameters
            .choice("--rule", asked.rule, {"search", "histogram", "planes"}, "search|histogram|planes",
                    "How --ppb selects the quantiser step of threepass and fringes:\nsearch: by search, to the byte\n"
                    "histogram: estimated from a histogram of coefficients\n"
                    "planes: the same, with whole bit planes as in Kartch's thesis")
            .needs(ppb)
            .acts_if(
                [&asked] { return asked.pixels_per_bit && coders().find(asked.compression.method.coder).three_pass; });
    parameters
        .number("--overhead", asked.overhead, "C",
                fmt::format("Bits per nonzero coefficient that the rule estimates for zerotrees (0 to 32; "
                            "default: {}, or {} with --symbols alphabets)",
                            default_overhead(ZerotreeSymbols::bits), default_overhead(ZerotreeSymbols::alphabets)))
        .range(0, 32)
        .needs(rule);
    const Parameter& step = parameters.number("--step", asked.step, "N", "Quantiser step, in units of radiance")
                                .positive()
                                .excludes(sqnr)
                                .excludes(ppb);
    const Parameter& max_error =
        parameters.number("--max-error", asked.max_error, "E", "Maximum error of every sample, in units of radiance")
            .positive()
            .excludes(sqnr)
            .excludes(ppb)
            .excludes(step);
    parameters.flag("--lossless", asked.lossless, "Keep every bit of all samples and depths")
        .excludes(sqnr)
        .excludes(ppb)
        .excludes(step)
        .excludes(max_error)
        .acts_if([&asked] { return asked.lossless; });
}

void declare_method(Parameters& parameters, CompressionParameters& asked) {
    CodingMethod& method = asked.compression.method;
    const auto coder = [&method]() -> const CoderInfo& { return coders().find(method.coder); };
    parameters.text("--coder", method.coder, "NAME", fmt::format("Coder: {}", fmt::join(coders().names(), ", ")));
    parameters
        .text("--transform", method.transform, "NAME",
              fmt::format("Transform, unless the coder is hogel: {} (default: cdf97, or dct8 for jpeg4d)",
                          fmt::join(transform_names(), ", ")))
        .acts_if([coder] { return !coder().transform.empty(); });
    parameters
        .choice("--table", asked.table, {"jpeg", "own"}, "jpeg|own",
                "Quantisation table of jpeg4d: JPEG's, or one optimised for the light field (default: own)")
        .acts_if([coder] { return coder().quantisation_table; });
    parameters
        .choice("--symbols", asked.symbols, {"bits", "alphabets"}, "bits|alphabets",
                "Zerotree symbols of threepass and fringes: single bits, or the alphabets of Kartch's thesis "
                "(default: bits)")
        .acts_if([coder] { return coder().three_pass; });
    parameters
        .choice("--hemicube", asked.hemicube, {"faces", "unfolded"}, "faces|unfolded",
                "How a hemicube is coded: face by face, or unfolded into one array that is smooth across edges")
        .acts_if([&asked] { return asked.has_sides; });
    const Parameter& no_depth =
        parameters.flag("--no-depth", asked.no_depth, "Leave out the depths of the rays").acts_if([&asked] {
            return asked.has_depth;
        });
    parameters
        .length("--depth-error", asked.depth_error,
                "Maximum error of a ray's depth (default: the hogel pitch divided by 32,000 times the tangent of the "
                "steepest ray, at most 1/1000 of the range of depths; 0 with --lossless)")
        .excludes(no_depth);
}

// Declares mappings that shift errors to values and colours to which the eye is less sensitive.
void declare_mapping(Parameters& parameters, CompressionParameters& asked) {
    // Targets that bound the error of every sample allow no mapping.
    const auto is_mapped = [&asked] { return !asked.max_error && !asked.lossless; };
    const Parameter& tone =
        parameters
            .choice("--tone", asked.tone, {"none", "histogram"}, "none|histogram",
                    "Compress the luminance by a tone curve from its histogram before coding; reading inverts the "
                    "curve. For high dynamic ranges. --sqnr and --step then refer to the compressed values")
            .acts_if(is_mapped);
    parameters
        .number("--tone-decades", asked.tone_decades, "N",
                "Decades of luminance after the curve (0.1 to 20); a smaller range gets no curve")
        .range(0.1, 20)
        .needs(tone)
        .acts_if([&asked] { return asked.tone == "histogram"; });
    parameters
        .number("--chrominance", asked.compression.chrominance, "F",
                "Quantise the two chrominance channels F times more coarsely than luminance (1 to 1024); --sqnr and "
                "--step then refer to colours with chrominance divided by F")
        .range(1, 1024)
        .acts_if(is_mapped);
}

}  // namespace

CompressionOptions CompressionParameters::options(const LightField& light_field) const {
    CompressionOptions chosen = compression;
    chosen.method = method_of(*this);
    if (overhead && rule == "search")
        throw Error(ErrorCode::usage, "overhead", "belongs to the rules histogram and planes");
    chosen.target = target_of(*this);
    if (tile.columns > 0) chosen.tile = HogelRange{0, 0, tile.columns, tile.rows};
    if (hemicube == "unfolded") chosen.layout = StreamLayout::unfolded;
    if (tone == "histogram") chosen.tone_decades = tone_decades;
    chosen.with_depth = light_field.has_depth() && !no_depth;
    chosen.depth_error = depth_error;
    constexpr double least = 1e-12;  // metres; smaller steps are below the precision of depths
    if (depth_error && *depth_error != 0 && !(*depth_error >= least))
        throw Error(ErrorCode::usage, "depth_error", "is neither 0 nor a positive length");
    if (depth_error && !chosen.with_depth)
        throw Error(ErrorCode::usage, "depth_error", "the light field has no depths");
    return chosen;
}

void CompressionParameters::resolve(const LightField& light_field) {
    CodingMethod& method = compression.method;
    const CoderInfo& coder = coders().find(method.coder);
    const CompressionTarget target = target_of(*this);
    if (const auto* ratio = std::get_if<Sqnr>(&target)) sqnr = ratio->decibels;
    if (method.transform.empty()) method.transform = coder.transform;
    if (coder.quantisation_table && table.empty()) table = "own";
    if (coder.three_pass && symbols.empty()) symbols = "bits";
    if (pixels_per_bit && rule != "search" && !overhead) overhead = default_overhead(symbol_codings.at(symbols));
    has_sides = light_field.has_sides();
    has_depth = light_field.has_depth();
}

void CompressionParameters::declare(Parameters& parameters) {
    declare_targets(parameters, *this);
    declare_method(parameters, *this);
    declare_mapping(parameters, *this);
    parameters.counts("--tile", tile, "Hogels across and down in a tile, coded as a unit; 0: selected automatically")
        .no_default();
}

}  // namespace hogel
