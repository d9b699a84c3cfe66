#include "hogel/codec/compress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "hogel/codec/block_kernels_internal.h"
#include "hogel/codec/exact_coder_internal.h"
#include "hogel/codec/search_internal.h"
#include "hogel/codec/stream_internal.h"
#include "hogel/codec/tone_adjustment_internal.h"
#include "hogel/core/error.h"
#include "hogel/core/parallel.h"

namespace hogel {
namespace {

constexpr double sqnr_tolerance = 0.1, rate_tolerance = 0.02;
constexpr std::size_t sampled = 8;  // tiles coded to guess the step
constexpr int most_passes = 12;
constexpr double likely_bounded_step = 3;        // times the error
constexpr double likely_lossless_step = 0x1p-7;  // times the root mean square

double decibels(double signal, double error) {
    return error > 0 ? 10 * std::log10(signal / error) : std::numeric_limits<double>::infinity();
}

// What coding tiles with a step gave.
struct Outcome {
    double signal = 0, error = 0, bytes = 0, samples = 0;  // samples with those that do not count

    double sqnr() const { return decibels(signal, error); }
    void add(const Outcome& other) {
        signal += other.signal;
        error += other.error;
        bytes += other.bytes;
        samples += other.samples;
    }
};

class Compression {
  public:
    // What is cut into tiles, by itself.
    struct Part {
        const LightFieldSource* source;
        std::unique_ptr<TileCoder> coder;
    };

    Compression(std::span<const Part> parts, const StreamInfo& info, StreamWriter& writer, const Progress& progress)
        : parts_(parts), tiling_(info.grid, info.tile), counted_(counted(info)), writer_(writer), progress_(progress) {}

    // Tiles of all parts, those of the first before those of the second.
    std::size_t tiles() const { return parts_.size() * tiling_.count(); }
    bool embedded() const { return parts_.front().coder->embedded(); }
    double samples() const {
        double sum = 0;
        for (const Part& part : parts_) sum += part.source->grid().samples();
        return sum;
    }

    // Codes these tiles, and writes them where that is wanted.
    Outcome code(std::span<const std::size_t> tiles, double step, bool write,
                 std::span<const std::size_t> most_bytes = {}) {
        if (write) {
            writer_.restart();
            sizes_.clear();
        }
        Outcome sum;
        parallel_ordered<Coded>(
            tiles.size(), in_flight(),
            [&](std::size_t i) {
                return code_tile(tiles[i], step, most_bytes.empty() ? TileCoder::no_limit : most_bytes[i]);
            },
            [&](std::size_t i, Coded& coded) {
                sum.add(coded.outcome);
                if (write) {
                    writer_.append(coded.bytes, coded.layers);
                    sizes_.push_back(coded.bytes.size());
                }
                report(progress_, static_cast<double>(i + 1) / static_cast<double>(tiles.size()));
            });
        return sum;
    }
    // The sums over the signal alone.
    Outcome look(std::span<const std::size_t> tiles) {
        Outcome sum;
        parallel_ordered<Outcome>(
            tiles.size(), in_flight(), [&](std::size_t i) { return read(tiles[i]).second; },
            [&](std::size_t, Outcome& outcome) { sum.add(outcome); });
        return sum;
    }
    // The bytes of the middle of the tile in the middle, and the root mean square of what is there.
    std::pair<double, double> try_middle(double step) const {
        HogelRange range = tiling_[tiling_.count() / 2];
        for (const auto& [begin, count] : {std::pair{&range.s0, &range.ns}, {&range.t0, &range.nt}}) {
            const std::size_t kept = std::min<std::size_t>(*count, 8);
            *begin += (*count - kept) / 2;
            *count = kept;
        }
        const auto [tile, outcome] = read(parts_.front(), range);
        const auto bytes = static_cast<double>(parts_.front().coder->encode(tile, step).bytes.size());
        return {bytes, std::sqrt(outcome.signal / outcome.samples)};
    }
    // Of the tiles last written.
    const std::vector<std::size_t>& sizes() const { return sizes_; }

  private:
    struct Coded {
        std::vector<std::uint8_t> bytes;
        std::vector<std::size_t> layers;
        Outcome outcome;
    };

    std::size_t in_flight() const { return std::min(default_in_flight(), parts_.front().coder->most_at_once()); }

    std::pair<LightFieldTile, Outcome> read(std::size_t index) const {
        return read(parts_[index / tiling_.count()], tiling_[index % tiling_.count()]);
    }
    std::pair<LightFieldTile, Outcome> read(const Part& part, const HogelRange& range) const {
        LightFieldTile tile(part.source->grid(), range, false);
        part.source->read(tile);
        Outcome outcome;
        const bool any_value = part.coder->takes_any_value();
        const std::size_t width = tile.radiance.extent(4), height = tile.radiance.extent(3);
        for (std::size_t row = 0; row < tile.radiance.size() / width; ++row) {
            const auto [begin, end] = counted_.columns(row % height, width);
            const auto values = tile.radiance.elements().subspan(row * width + begin, end - begin);
            const double squares = sum_of_squares(values.data(), values.size());
            if (std::isfinite(squares) || !any_value)
                outcome.signal += squares;
            else
                for (const float value : values)
                    if (std::isfinite(value)) outcome.signal += static_cast<double>(value) * value;
        }
        if (!std::isfinite(outcome.signal))
            throw Error(ErrorCode::bad_input,
                        fmt::format("radiance is not finite everywhere in hogels {} to {} of rows {} to {}", range.s0,
                                    range.s0 + range.ns - 1, range.t0, range.t0 + range.nt - 1));
        outcome.samples = static_cast<double>(tile.radiance.size());
        return {std::move(tile), outcome};
    }

    Coded code_tile(std::size_t index, double step, std::size_t most_bytes) const {
        auto [tile, outcome] = read(index);
        TileCoder::Encoded encoded = parts_[index / tiling_.count()].coder->encode(tile, step, most_bytes);
        outcome.error = encoded.squared_error;
        outcome.bytes = static_cast<double>(encoded.bytes.size());
        return {std::move(encoded.bytes), std::move(encoded.layers), outcome};
    }

    std::span<const Part> parts_;
    Tiling tiling_;
    DirectionCross counted_;
    StreamWriter& writer_;
    const Progress& progress_;
    std::vector<std::size_t> sizes_;
};

std::vector<std::size_t> all_tiles(std::size_t count) {
    std::vector<std::size_t> tiles(count);
    std::iota(tiles.begin(), tiles.end(), 0);
    return tiles;
}

// Some tiles, spread over the light field.
std::vector<std::size_t> some_tiles(std::size_t count) {
    std::vector<std::size_t> tiles;
    for (std::size_t i = 0; i < sampled; ++i) tiles.push_back((2 * i + 1) * count / (2 * sampled));
    return tiles;
}

// Sizes that are `room` bytes together, each the same part of what it was.
std::vector<std::size_t> cut(const std::vector<std::size_t>& sizes, double room) {
    std::size_t left = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    auto bytes = static_cast<std::size_t>(std::max(room, 0.0));
    std::vector<std::size_t> result;
    for (const std::size_t size : sizes) {
        result.push_back(left > 0 ? static_cast<std::size_t>(static_cast<double>(bytes) * static_cast<double>(size) /
                                                             static_cast<double>(left))
                                  : 0);
        left -= size;
        bytes -= result.back();
    }
    return result;
}

void check(const CompressionTarget& target) {
    if (target.sqnr.has_value() + target.pixels_per_bit.has_value() + target.step.has_value() +
            target.max_error.has_value() + target.lossless !=
        1)
        throw Error(ErrorCode::usage,
                    "compression: expected exactly one of an SQNR, a rate, a step, an error and lossless");
    if (target.max_error && !(*target.max_error > 0 && std::isfinite(*target.max_error)))
        throw Error(ErrorCode::usage,
                    fmt::format("an error of {} was asked for, expected a positive one", *target.max_error));
    if (target.sqnr && !(*target.sqnr > 0 && *target.sqnr <= 120))
        throw Error(ErrorCode::usage, fmt::format("an SQNR of {} dB was asked for, expected 0 to 120", *target.sqnr));
    if (target.pixels_per_bit && !(*target.pixels_per_bit > 0 && std::isfinite(*target.pixels_per_bit)))
        throw Error(ErrorCode::usage, fmt::format("{} pixels per bit were asked for, expected a positive number",
                                                  *target.pixels_per_bit));
    if (target.step && !(*target.step > 0 && std::isfinite(*target.step)))
        throw Error(ErrorCode::usage, fmt::format("a step of {} was asked for, expected a positive one", *target.step));
}

// What the figure that is searched for must lie between: an SQNR, or the logarithm of the number of bytes. Both fall
// with the logarithm of the step.
struct Band {
    double low, high;
    bool above_is_better;  // of the two nearest misses, the one above the band is the better; else the one below
    double slope;
};

Band band_of(const CompressionTarget& target, double pixels, bool embedded) {
    if (target.sqnr) return {*target.sqnr, *target.sqnr + sqnr_tolerance, true, -5.5};
    const double bytes = std::log2(pixels / *target.pixels_per_bit / 8);
    // An embedded stream is made a little too long, and then cut.
    if (embedded) return {bytes, bytes + std::log2(1 + rate_tolerance), true, -0.9};
    return {bytes + std::log2(1 - rate_tolerance), bytes, false, -0.9};
}

// Searches with some tiles or all. Returns the logarithm of the step, and leaves the last outcome.
class StepSearch {
  public:
    StepSearch(Compression& compression, const Band& band, std::function<double(const Outcome&)> figure)
        : compression_(compression), band_(band), figure_(std::move(figure)) {}

    double run(std::span<const std::size_t> tiles, bool write, double start) {
        Search search(band_.low, band_.high, start, slope_);
        for (int pass = 0; pass < most_passes; ++pass) {
            const double place = search.next();
            outcome_ = compression_.code(tiles, std::exp2(place), write);
            ++passes_;
            const bool found = search.tell(figure_(outcome_));
            slope_ = search.slope();
            if (found) return place;
            const bool narrow =
                search.above() && search.below() && *search.below() - *search.above() < least_difference;
            if (narrow) break;
        }
        const std::optional<double> best = band_.above_is_better ? search.above() : search.below();
        const double place = best.value_or(search.next());
        if (write) {
            outcome_ = compression_.code(tiles, std::exp2(place), write);
            ++passes_;
        }
        return place;
    }
    const Outcome& outcome() const { return outcome_; }
    int passes() const { return passes_; }

  private:
    static constexpr double least_difference = 1e-5;
    Compression& compression_;
    Band band_;
    std::function<double(const Outcome&)> figure_;
    double slope_ = band_.slope;
    Outcome outcome_;
    int passes_ = 0;
};

// The step of a prediction that makes tiles smallest, by halves and doubles from a likely one.
double smallest_step(const Compression& compression, const CompressionTarget& target) {
    constexpr int most = 8;
    double start = target.max_error ? likely_bounded_step * *target.max_error
                                    : likely_lossless_step * compression.try_middle(1).second;
    if (!(start > 0)) start = 1;
    const auto bytes = [&](int power) { return compression.try_middle(std::ldexp(start, power)).first; };
    int best = 0;
    double least = bytes(0);
    for (const int way : {1, -1}) {
        for (int power = way; std::abs(power) < most; power += way) {
            const double here = bytes(power);
            if (here >= least) break;
            least = here;
            best = power;
        }
        if (best != 0) break;
    }
    return std::ldexp(start, best);
}

std::unique_ptr<TileCoder> coder_for(const StreamInfo& info, const LightFieldGrid& part,
                                     const CompressionTarget& target) {
    if (target.max_error) return make_bounded_coder(part, counted(info), *target.max_error);
    return make_tile_coder(info.method, part, counted(info));
}

RadianceMapping mapping_for(std::span<const LightFieldSource* const> faces, const CompressionOptions& options,
                            const Progress& progress) {
    const CompressionTarget& target = options.target;
    RadianceMapping mapping;
    if (!options.tone_decades && options.chrominance == 1) return mapping;
    if (target.lossless || target.max_error)
        throw Error(ErrorCode::usage,
                    "a tone curve or coarser chrominance neither keep to an error nor are lossless; expected an SQNR, "
                    "a rate or a step");
    if (!(options.chrominance >= 1 && options.chrominance <= RadianceMapping::most_chrominance))
        throw Error(ErrorCode::usage, fmt::format("chrominance {} times as coarse was asked for, expected 1 to {}",
                                                  options.chrominance, RadianceMapping::most_chrominance));
    if (options.chrominance != 1 && faces.front()->grid().channels != 3)
        throw Error(ErrorCode::usage, "coarser chrominance was asked for of a light field of one channel, expected 3");
    mapping.chrominance = static_cast<float>(options.chrominance);
    if (!options.tone_decades) return mapping;
    if (!(*options.tone_decades >= 0.1 && *options.tone_decades <= 20))
        throw Error(ErrorCode::usage,
                    fmt::format("a tone curve to {} decades was asked for, expected 0.1 to 20", *options.tone_decades));
    mapping.tone = adjusted_curve(luminance_histogram(faces, progress), *options.tone_decades);
    return mapping;
}

// The light fields as they are coded.
struct MappedFaces {
    std::vector<std::unique_ptr<LightFieldSource>> mapped;
    std::vector<const LightFieldSource*> faces;

    MappedFaces(std::span<const LightFieldSource* const> sources, const RadianceMapping& mapping)
        : faces(sources.begin(), sources.end()) {
        if (!mapping.changes()) return;
        for (const LightFieldSource*& face : faces) face = mapped.emplace_back(map_radiances(*face, mapping)).get();
    }
};

}  // namespace

CompressionResult compress(const LightFieldSource& source, const std::filesystem::path& path,
                           const CompressionOptions& options, const Progress& progress) {
    const LightFieldSource* const only = &source;
    return compress({&only, 1}, path, options, progress);
}

CompressionResult compress(std::span<const LightFieldSource* const> sources, const std::filesystem::path& path,
                           const CompressionOptions& options, const Progress& progress) {
    check(options.target);
    const LightFieldGrid& grid = sources.front()->grid();
    const bool exact = options.target.lossless || options.target.max_error;
    if (exact && options.method != CodingMethod{})
        throw Error(ErrorCode::usage, fmt::format("coder {} cannot keep to an error, nor be lossless; expected hogel",
                                                  options.method.coder));
    require_tangents(grid, ErrorCode::usage, "a compressed light field");
    const RadianceMapping mapping = mapping_for(sources, options, progress);
    const MappedFaces mapped(sources, mapping);
    const std::span<const LightFieldSource* const> faces = mapped.faces;
    StreamInfo info{grid, {}, options.method, options.metadata, {}, options.layout, mapping};
    if (exact) info.method.coder = options.target.lossless ? "lossless" : "bounded";
    double pixels = 0;
    for (const LightFieldSource* face : faces) {
        if (face != faces.front()) info.sides.push_back(face->grid());
        pixels += static_cast<double>(face->grid().directions()) * static_cast<double>(grid.hogels());
    }
    if (info.sides.empty()) info.layout = HemicubeLayout::faces;
    const std::vector<LightFieldGrid> grids = coded_parts(info);
    const auto unfolded = info.layout == HemicubeLayout::unfolded ? unfold(faces) : std::unique_ptr<LightFieldSource>{};
    std::vector<Compression::Part> parts;
    for (std::size_t i = 0; i < grids.size(); ++i)
        parts.push_back({unfolded ? unfolded.get() : faces[i], coder_for(info, grids[i], options.target)});
    info.tile = options.tile.value_or(parts.front().coder->preferred_tile(grids.front()));
    info.tile.ns = std::min(info.tile.ns, grid.hogels_s);
    info.tile.nt = std::min(info.tile.nt, grid.hogels_t);
    info.layer_ends.resize(parts.front().coder->layers(info.tile));
    StreamWriter writer(path, info);
    Compression compression(parts, info, writer, progress);
    const CompressionTarget& target = options.target;
    const std::vector<std::size_t> all = all_tiles(compression.tiles());

    CompressionResult result;
    Outcome outcome;
    if (target.step || exact) {
        result.step = exact ? smallest_step(compression, target) : *target.step;
        outcome = compression.code(all, result.step, true);
        result.passes = 1;
    } else {
        const std::vector<std::size_t> some = all.size() >= 3 * sampled ? some_tiles(all.size()) : all;
        const Outcome seen = compression.look(some);
        // Detail of the step's size everywhere has an error of step²/12.
        const double rms = std::sqrt(seen.signal / seen.samples);
        double place =
            std::log2(rms > 0 ? rms * (target.sqnr ? std::sqrt(12) * std::pow(10, -*target.sqnr / 20) : 0.1) : 1);
        StepSearch search(compression, band_of(target, pixels, compression.embedded()), [&](const Outcome& o) {
            if (target.sqnr) return o.sqnr();
            const double overhead = static_cast<double>(writer.overhead(all.size()));
            return std::log2(o.bytes * (compression.samples() / o.samples) + overhead);
        });
        if (some.size() < all.size()) place = search.run(some, false, place);
        place = search.run(all, true, place);
        outcome = search.outcome();
        result.step = std::exp2(place);
        result.passes = search.passes();
        const double most = std::floor(pixels / target.pixels_per_bit.value_or(pixels) / 8);
        if (target.pixels_per_bit && compression.embedded() && static_cast<double>(writer.size()) > most) {
            const double room = most - static_cast<double>(writer.overhead(all.size()));
            outcome = compression.code(all, result.step, true, cut(compression.sizes(), room));
            ++result.passes;
        }
    }
    result.bytes = writer.size();
    writer.finish();
    result.sqnr = outcome.sqnr();
    result.pixels_per_bit = pixels / (8 * static_cast<double>(result.bytes));
    return result;
}

}  // namespace hogel
