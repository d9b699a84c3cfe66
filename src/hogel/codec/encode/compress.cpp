// SPDX-License-Identifier: Apache-2.0
#include "hogel/compress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hogel/codec/encode/depth.h"
#include "hogel/codec/encode/histogram_tone_mapping.h"
#include "hogel/codec/encode/layout_choice.h"
#include "hogel/codec/encode/target.h"
#include "hogel/codec/encode/tile_compression.h"
#include "hogel/codec/exact_coder.h"
#include "hogel/codec/format/stacked.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/codec/format/unfolded.h"
#include "hogel/communicator.h"
#include "hogel/core/rates.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel {

using namespace codec;
using namespace codec::encode;
using namespace codec::format;

namespace {

// Fractions of the requested bytes that may be missing after the search of a step: in the first search, with some
// tiles, and in the last, with all tiles (docs/decisions/0037-codec-rate-control.md). Filler replaces the missing
// bytes.
constexpr double first_tolerance = 0.02, last_tolerance = 0.004;
constexpr std::size_t sampled = 8;  // number of tiles that are coded to estimate the step

std::vector<std::size_t> all_tiles(std::size_t count) {
    std::vector<std::size_t> tiles(count);
    std::iota(tiles.begin(), tiles.end(), 0);
    return tiles;
}

// Returns the indices of some tiles, spread over the light field.
std::vector<std::size_t> some_tiles(std::size_t count) {
    std::vector<std::size_t> tiles;
    for (std::size_t i = 0; i < sampled; ++i) tiles.push_back((2 * i + 1) * count / (2 * sampled));
    return tiles;
}

// Returns the step of the prediction that minimises tile sizes, found by halving and doubling a likely step.
double step_of_min_bytes(const TileCompression& compression, const CompressionTarget& target) {
    constexpr int max_power = 8;
    const bool lossless = std::holds_alternative<Lossless>(target);
    double start = likely_step(target, lossless ? compression.try_middle(1).second : 0);
    if (!(start > 0)) start = 1;
    const auto bytes = [&](int power) { return compression.try_middle(std::ldexp(start, power)).first; };
    int best = 0;
    double min_bytes = bytes(0);
    for (const int direction : {1, -1}) {
        for (int power = direction; std::abs(power) < max_power; power += direction) {
            const double tile_bytes = bytes(power);
            if (tile_bytes >= min_bytes) break;
            min_bytes = tile_bytes;
            best = power;
        }
        if (best != 0) break;
    }
    return std::ldexp(start, best);
}

// Returns the coding method with its name in a stream. Throws Error(usage) for an unknown method, or one that cannot
// meet the target.
CodingMethod method_for(const CompressionOptions& options) {
    CodingMethod method = options.method;
    if (is_exact(options.target)) {
        if (method != CodingMethod{})
            throw Error(ErrorCode::usage, "coder, lossless, max_error",
                        fmt::format("coder {} can neither bound the error of every sample nor be lossless; expected "
                                    "hogel",
                                    method.coder));
        method.coder = std::holds_alternative<Lossless>(options.target) ? "lossless" : "bounded";
        return method;
    }
    const CoderInfo& coder = coders().find(method.coder);
    if (method.transform.empty()) method.transform = coder.transform;
    if (coder.three_pass) return method;
    const auto* const rate = std::get_if<PixelsPerBit>(&options.target);
    if (rate && rate->rule != RateRule::search)
        throw Error(ErrorCode::usage, "rule",
                    fmt::format("coder {} has no rule that finds a step for a rate; expected "
                                "threepass or fringes, or the search",
                                coder.name));
    if (method.symbols != ZerotreeSymbols::bits)
        throw Error(ErrorCode::usage, "symbols",
                    fmt::format("coder {} has no alphabets of zerotrees; expected threepass or "
                                "fringes",
                                coder.name));
    return method;
}

std::unique_ptr<TileCoder> coder_for(const StreamInfo& info, const LightFieldGrid& part,
                                     const CompressionTarget& target) {
    const auto* const bound = std::get_if<MaxError>(&target);
    if (!bound) return coder_of_part(info, part);
    return coder_in_layout(info.layout, part, [counted = counted(info), error = bound->radiance](const auto& grid) {
        return make_bounded_coder(grid, counted, error);
    });
}

Companding companding_for(const LightField& light_field, const CompressionOptions& options, const Progress& progress) {
    Companding companding;
    if (!options.tone_decades && options.chrominance == 1) return companding;
    if (is_exact(options.target))
        throw Error(ErrorCode::usage, "tone, chrominance",
                    "tone mapping and coarser chrominance neither bound the error of every sample nor are lossless; "
                    "expected an SQNR, a rate or a step");
    if (!(options.chrominance >= 1 && options.chrominance <= Companding::max_chrominance))
        throw Error(ErrorCode::usage, "chrominance",
                    fmt::format("chrominance {} times as coarse was asked for, expected 1 to {}", options.chrominance,
                                Companding::max_chrominance));
    if (options.chrominance != 1 && light_field.grid().channels != 3)
        throw Error(ErrorCode::usage, "chrominance",
                    "coarser chrominance was asked for of a light field of one channel, expected 3");
    companding.chrominance = static_cast<float>(options.chrominance);
    if (!options.tone_decades) return companding;
    if (!(*options.tone_decades >= 0.1 && *options.tone_decades <= 20))
        throw Error(ErrorCode::usage, "tone_decades",
                    fmt::format("tone mapping to {} decades was asked for, expected 0.1 to 20", *options.tone_decades));
    companding.tone = tone_curve_of(luminance_histogram(light_field, progress), *options.tone_decades);
    return companding;
}

// Result of a search for a coding of all tiles that meets a target.
struct Found {
    CodingOutcome outcome;
    double step = 0;
    int passes = 1;
    std::uint64_t filler = 0;
};

// Cuts embedded codes or adds filler after all tiles were written, so that the file has the requested number of bytes.
// @param budget   maximum number of bytes without filler
void meet_rate(const PixelsPerBit& target, double bytes, double budget, StepFound step_found,
               TileCompression& compression, const StreamWriter& writer, Found& found) {
    if (compression.embedded() && static_cast<double>(writer.size()) > bytes) {
        const std::vector<std::size_t> tiles = all_tiles(compression.tiles());
        found.outcome = compression.code(tiles, found.step, true, compression.cut(bytes));
        ++found.passes;
    }
    if (step_found == StepFound::only_below || static_cast<double>(writer.size()) > budget)
        refuse_rate(target, bytes, writer.size());
    found.filler = std::min(static_cast<std::uint64_t>(bytes) - writer.size(), std::uint64_t{max_filler});
}

// Searches the step for an SQNR or a rate.
Found search_step(const CompressionTarget& target, double rays, const std::string& coder, TileCompression& compression,
                  const StreamWriter& writer) {
    const std::vector<std::size_t> tiles = all_tiles(compression.tiles());
    const std::vector<std::size_t> sample_tiles = tiles.size() >= 3 * sampled ? some_tiles(tiles.size()) : tiles;
    const auto* const rate = std::get_if<PixelsPerBit>(&target);
    const CodingOutcome sums = compression.look(sample_tiles);
    const double likely = likely_step(target, std::sqrt(sums.signal / sums.samples));
    StepSearch search(likely > 0 ? std::log2(likely) : 0, [&](const CodingOutcome& o) {
        if (!rate) return o.sqnr();
        const double overhead = static_cast<double>(writer.overhead(tiles.size()));
        return std::log2(o.bytes * (compression.samples() / o.samples) + overhead);
    });
    const double bytes = rate ? bytes_of_rate(*rate, rays, compression.samples()) : 0;
    const bool embedded = compression.embedded();
    const double budget = std::max(bytes - (embedded ? 0 : static_cast<double>(min_filler)), 1.0);
    const auto band = [&](double tolerance) {
        return rate ? band_of_bytes(budget, tolerance, embedded) : band_of_sqnr(std::get<Sqnr>(target).decibels);
    };
    if (sample_tiles.size() < tiles.size())
        search.run(band(first_tolerance), [&](double step) { return compression.code(sample_tiles, step, false); });
    const double tolerance =
        embedded ? first_tolerance : std::min(last_tolerance, static_cast<double>(max_filler) / bytes);
    const StepFound step_found =
        search.run(band(tolerance), [&](double step) { return compression.code(tiles, step, true); });
    Found found{search.outcome(), search.step(), search.passes()};
    if (!embedded || !rate) check_quality(target, found.outcome, found.step, coder);
    if (rate) meet_rate(*rate, bytes, budget, step_found, compression, writer, found);
    return found;
}

// Codes once with the step that a rule yields for a rate.
Found code_by_rule(const PixelsPerBit& target, double rays, const CodingMethod& method, TileCompression& compression,
                   const StreamWriter& writer) {
    const std::vector<std::size_t> tiles = all_tiles(compression.tiles());
    const double bytes = bytes_of_rate(target, rays, compression.samples());
    const coding::MagnitudeHistogram magnitudes = compression.magnitudes();
    const double bits = 8 * (bytes - static_cast<double>(writer.overhead(tiles.size())));
    if (bits <= 0) refuse_rate(target, bytes, writer.overhead(tiles.size()));
    Found found;
    found.step = step_by_rule(target, method.symbols, magnitudes, bits);
    found.outcome = compression.code(tiles, found.step, true);
    check_quality(target, found.outcome, found.step, method.coder);
    return found;
}

Found code_to_target(const CompressionTarget& target, double rays, const CodingMethod& method,
                     TileCompression& compression, const StreamWriter& writer) {
    const std::string& coder = method.coder;
    const auto* const fixed = std::get_if<Step>(&target);
    const auto* const rate = std::get_if<PixelsPerBit>(&target);
    if (rate && rate->rule != RateRule::search) return code_by_rule(*rate, rays, method, compression, writer);
    if (!fixed && !is_exact(target)) return search_step(target, rays, coder, compression, writer);
    Found found;
    found.step = fixed ? fixed->radiance : step_of_min_bytes(compression, target);
    found.outcome = compression.code(all_tiles(compression.tiles()), found.step, true);
    if (fixed) check_quality(target, found.outcome, found.step, coder);
    return found;
}

CompressionResult compress_into(core::RawFile* into, const LightField& light_field, const std::filesystem::path& path,
                                const CompressionOptions& options, const Progress& progress);

// Codes the depth into an unnamed file, which exists only in the root rank.
StreamInfo::Depth code_depth(core::RawFile* into, const LightField& light_field, const std::filesystem::path& path,
                             const CompressionOptions& options) {
    return compress_depth(light_field, options, [&](const LightField& depth, const CompressionOptions& exact) {
        return compress_into(into, depth, path, exact, {}).bytes;
    });
}

HogelRange tile_for(const CompressionOptions& options, const TileCoder& coder, const LightFieldGrid& part,
                    const LightFieldGrid& grid) {
    HogelRange tile = options.tile.value_or(coder.preferred_tile(part));
    tile.ns = std::min(tile.ns, grid.hogels_s);
    tile.nt = std::min(tile.nt, grid.hogels_t);
    return tile;
}

// Maximum bytes of the file: a quantiser alone needs one bit per 6.02 dB.
double max_file_bytes(const LightField& light_field, const CompressionTarget& target) {
    const double samples = light_field.samples();
    if (const auto* rate = std::get_if<PixelsPerBit>(&target)) {
        // Rules meet the rate approximately; the rule of whole bit planes misses it by up to a factor of two.
        const double may_exceed = rate->rule == RateRule::search ? 1 : 2;
        return may_exceed * samples / static_cast<double>(light_field.grid().channels) / 8 / rate->rate;
    }
    if (const auto* sqnr = std::get_if<Sqnr>(&target)) return samples * (sqnr->decibels / 6.02 + 0.5) / 8;
    return samples * sizeof(float);
}

// Writes the stream to `into`, or to `path` if `into` is null.
CompressionResult compress_into(core::RawFile* into, const LightField& light_field, const std::filesystem::path& path,
                                const CompressionOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    check(options.target);
    const LightFieldGrid& grid = light_field.grid();
    StreamHeader header;
    header.grid = grid;
    header.method = method_for(options);
    header.metadata = with_history(options.metadata, to_metadata(light_field.provenance()));
    header.companding = companding_for(light_field, options, progress);
    const LightField coded = header.companding.changes() ? companded(light_field, header.companding) : light_field;
    for (const LightField::Source& side : coded.faces().subspan(1)) header.sides.push_back(side->grid());
    const double rays = coded.samples() / static_cast<double>(grid.channels);
    const CoderOfFace coder_of = [&](const StreamInfo& stream, const LightFieldGrid& part) {
        return coder_for(stream, part, options.target);
    };
    header.layout = choose_layout(coded, header, options, coder_of);
    const std::vector<LightFieldGrid> grids = coded_parts(header);
    const bool unfolded = header.layout == StreamLayout::unfolded;
    std::vector<CodedPart> parts;
    for (std::size_t i = 0; i < grids.size(); ++i)
        parts.push_back({unfolded ? unfold(coded) : coded.faces()[i], coder_of(header, grids[i])});
    header.tile = tile_for(options, *parts.front().coder, grids.front(), grid);
    header.layer_ends.resize(parts.front().coder->layers(header.tile));
    std::optional<core::RawFile> depth;
    if (options.with_depth && is_root_rank()) depth.emplace(core::folder_of(path), core::RawFile::Mode::unnamed, path);
    if (options.with_depth) header.depth = code_depth(depth ? &*depth : nullptr, light_field, path, options);
    StreamWriter writer(path, header, into, depth ? &*depth : nullptr);
    TileCompression compression(parts, header, writer, progress);
    const Found found = code_to_target(options.target, rays, options.method, compression, writer);
    CompressionResult result;
    result.bytes = writer.size() + found.filler;
    result.sqnr = found.outcome.sqnr();
    result.pixels_per_bit = rays / (8 * static_cast<double>(result.bytes));
    result.step = found.step;
    result.passes = found.passes;
    result.depth_bytes = header.depth.bytes;
    result.depth_error = header.depth.error;
    writer.finish(found.filler);
    return result;
}

}  // namespace

double default_overhead(ZerotreeSymbols symbols) {
    // Medians over transforms and rates of docs/decisions/0043-codec-thesis-transforms.md.
    return symbols == ZerotreeSymbols::alphabets ? 4.5 : 2.5;
}

CompressionResult compress(const LightField& light_field, const std::filesystem::path& path,
                           const CompressionOptions& options, const Progress& progress) {
    return compress_into(nullptr, light_field, path, options, progress);
}

Plan plan_compression(const LightField& light_field, const CompressionOptions& options) {
    const LightFieldGrid& grid = light_field.grid();
    StreamInfo stream;
    stream.method = method_for(options);
    const auto coder = coder_for(stream, grid, options.target);
    const HogelRange tile = tile_for(options, *coder, grid, grid);
    const double tiles = std::ceil(static_cast<double>(grid.hogels()) / static_cast<double>(tile.hogels()));
    const double at_once = std::min(tiles, static_cast<double>(std::min(coder->max_at_once(), thread_count())));
    // Arrays of each tile in progress: the tile, its prediction, its residual and its coefficients.
    constexpr double arrays = 4;
    const double tile_samples = static_cast<double>(tile.hogels() * grid.directions() * grid.channels);
    Plan plan;
    plan.memory = arrays * at_once * tile_samples * sizeof(float);
    plan.disk = max_file_bytes(light_field, options.target);
    if (options.with_depth) plan.disk += light_field.samples() / static_cast<double>(grid.channels) * sizeof(float);
    plan.seconds = core::rates::on_all_threads(light_field.samples() * core::rates::coded_sample);
    return plan;
}

}  // namespace hogel
