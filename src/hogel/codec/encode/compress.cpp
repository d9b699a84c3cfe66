// SPDX-License-Identifier: Apache-2.0
#include "hogel/compress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "hogel/codec/encode/depth.h"
#include "hogel/codec/encode/histogram_tone_mapping.h"
#include "hogel/codec/encode/layout_choice.h"
#include "hogel/codec/encode/step_search.h"
#include "hogel/codec/exact_coder.h"
#include "hogel/codec/format/block_kernels.h"
#include "hogel/codec/format/stacked.h"
#include "hogel/codec/format/stream_file.h"
#include "hogel/codec/format/stream_header.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"

namespace hogel {

using namespace codec;
using namespace codec::encode;
using namespace codec::format;

namespace {

// Of the bytes that were asked for, how many may be missing, where a step is looked for with some of the tiles and then
// with all. The rest is filled up.
constexpr double first_tolerance = 0.02, last_tolerance = 0.004;
// More than a sample has to tell: floats have 24 bits, and what they are multiplied by.
constexpr double max_bits_of_sample = 24;
constexpr std::size_t sampled = 8;  // tiles coded to guess the step

// Sizes that are `room` bytes together, and each the same part of what it was beyond the least.
std::vector<std::size_t> cut_sizes(const std::vector<std::size_t>& sizes, std::size_t least, double room) {
    std::size_t left = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}) - least * sizes.size();
    auto bytes = static_cast<std::size_t>(std::max(room - static_cast<double>(least * sizes.size()), 0.0));
    std::vector<std::size_t> result;
    for (const std::size_t size : sizes) {
        const std::size_t more = size - least;
        const double kept =
            left > 0 ? static_cast<double>(bytes) * static_cast<double>(more) / static_cast<double>(left) : 0;
        result.push_back(least + static_cast<std::size_t>(kept));
        left -= more;
        bytes -= result.back() - least;
    }
    return result;
}

// Tiles that have been coded, whose memory serves the next ones: to be given new memory takes longer than to write it.
class SpareTiles {
  public:
    LightFieldTile take(const LightFieldGrid& grid, const HogelRange& range) {
        const std::lock_guard lock(mutex_);
        const auto found = std::ranges::find_if(tiles_, [&](const LightFieldTile& tile) {
            const Shape<5> shape{grid.channels, range.nt, range.ns, grid.directions_v, grid.directions_u};
            return tile.radiance.shape() == shape;
        });
        if (found == tiles_.end()) return LightFieldTile(grid, range, false);
        LightFieldTile tile = std::move(*found);
        tiles_.erase(found);
        tile.range = range;
        return tile;
    }
    void give_back(LightFieldTile tile) {
        const std::lock_guard lock(mutex_);
        tiles_.push_back(std::move(tile));
    }

  private:
    std::mutex mutex_;
    std::vector<LightFieldTile> tiles_;
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
    bool embedded() const { return parts_.front().coder->min_bytes(parts_.front().source->grid()).has_value(); }
    double samples() const {
        double sum = 0;
        for (const Part& part : parts_) sum += part.source->grid().samples();
        return sum;
    }

    // RawPixels these tiles, and writes them where that is wanted.
    CodingOutcome code(std::span<const std::size_t> tiles, double step, bool write,
                       std::span<const std::size_t> max_bytes = {}) {
        if (write) {
            writer_.restart();
            sizes_.clear();
        }
        CodingOutcome sum;
        core::parallel_ordered<Coded>(
            tiles.size(), in_flight(),
            [&](std::size_t i) {
                return code_tile(tiles[i], step, max_bytes.empty() ? TileCoder::no_limit : max_bytes[i]);
            },
            [&](std::size_t i, Coded& coded) {
                sum.add(coded.outcome);
                if (write) {
                    writer_.append(coded.bytes, coded.layers);
                    sizes_.push_back(coded.bytes.size());
                }
                progress_.report(static_cast<double>(i + 1) / static_cast<double>(tiles.size()));
            });
        return sum;
    }
    // The sums over the signal alone.
    CodingOutcome look(std::span<const std::size_t> tiles) {
        CodingOutcome sum;
        core::parallel_ordered<CodingOutcome>(
            tiles.size(), in_flight(),
            [&](std::size_t i) {
                auto [tile, outcome] = read(tiles[i]);
                spare_.give_back(std::move(tile));
                return outcome;
            },
            [&](std::size_t, CodingOutcome& outcome) { sum.add(outcome); });
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
        auto [tile, outcome] = read(parts_.front(), range);
        const auto bytes = static_cast<double>(parts_.front().coder->encode(tile, step).bytes.size());
        return {bytes, std::sqrt(outcome.signal / outcome.samples)};
    }
    // The bytes that the tiles last written may have each, so that the whole file has so many.
    std::vector<std::size_t> cut(double file) const {
        const double room = file - static_cast<double>(writer_.overhead(sizes_.size()));
        return cut_sizes(sizes_, *parts_.front().coder->min_bytes(parts_.front().source->grid()), room);
    }

  private:
    struct Coded {
        std::vector<std::uint8_t> bytes;
        std::vector<std::size_t> layers;
        CodingOutcome outcome;
    };

    std::size_t in_flight() const { return std::min(core::default_in_flight(), parts_.front().coder->max_at_once()); }

    std::pair<LightFieldTile, CodingOutcome> read(std::size_t index) const {
        return read(parts_[index / tiling_.count()], tiling_[index % tiling_.count()]);
    }
    std::pair<LightFieldTile, CodingOutcome> read(const Part& part, const HogelRange& range) const {
        LightFieldTile tile = spare_.take(part.source->grid(), range);
        part.source->read(tile);
        CodingOutcome outcome;
        const bool any_value = part.coder->takes_any_value();
        const std::size_t width = tile.radiance.extent(4), height = tile.radiance.extent(3);
        std::vector<double> signal(tile.radiance.size() / (width * height));  // of each hogel and channel
        core::parallel_for(signal.size(), [&](std::size_t hogel) {
            for (std::size_t v = 0; v < height; ++v) {
                const auto [begin, end] = counted_.columns(v, width);
                const auto values = tile.radiance.elements().subspan((hogel * height + v) * width + begin, end - begin);
                const double squares = sum_of_squares(values.data(), values.size());
                if (std::isfinite(squares) || !any_value)
                    signal[hogel] += squares;
                else
                    for (const float value : values)
                        if (std::isfinite(value)) signal[hogel] += static_cast<double>(value) * value;
            }
        });
        outcome.signal = std::accumulate(signal.begin(), signal.end(), 0.0);
        if (!std::isfinite(outcome.signal))
            throw Error(ErrorCode::bad_input,
                        fmt::format("radiance is not finite everywhere in hogels {} to {} of rows {} to {}", range.s0,
                                    range.s0 + range.ns - 1, range.t0, range.t0 + range.nt - 1));
        outcome.samples = static_cast<double>(tile.radiance.size());
        return {std::move(tile), outcome};
    }

    Coded code_tile(std::size_t index, double step, std::size_t max_bytes) const {
        auto [tile, outcome] = read(index);
        TileCoder::Encoded encoded = parts_[index / tiling_.count()].coder->encode(tile, step, max_bytes);
        spare_.give_back(std::move(tile));
        outcome.error = encoded.squared_error;
        outcome.bytes = static_cast<double>(encoded.bytes.size());
        return {std::move(encoded.bytes), std::move(encoded.layers), outcome};
    }

    std::span<const Part> parts_;
    Tiling tiling_;
    DirectionCross counted_;
    StreamWriter& writer_;
    const Progress& progress_;
    mutable SpareTiles spare_;
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

// Of a file of the rate that was asked for. Throws Error(usage) where that is more than there is to tell.
double max_bytes(double pixels_per_bit, double pixels, double samples) {
    const double bytes = std::floor(pixels / pixels_per_bit / 8);
    if (8 * bytes > max_bits_of_sample * samples)
        throw Error(
            ErrorCode::usage,
            fmt::format("{} pixels per bit were asked for, more than {} bits a sample; expected at least {:.3g} "
                        "pixels per bit, or --lossless",
                        pixels_per_bit, max_bits_of_sample, pixels / (max_bits_of_sample * samples)));
    return bytes;
}

[[noreturn]] void refuse_rate(double pixels_per_bit, double bytes, std::uint64_t nearest) {
    throw Error(ErrorCode::usage,
                fmt::format("{} pixels per bit were asked for, {} bytes; the {} file of this light field has {}{}",
                            pixels_per_bit, bytes, static_cast<double>(nearest) < bytes ? "largest" : "smallest",
                            nearest, static_cast<double>(nearest) < bytes ? ", but for --lossless" : ""));
}

// Where levels or floats are too short for so fine a step, errors are many times as large as it. Throws Error(usage).
void check_quality(const CompressionTarget& target, const CodingOutcome& outcome, double step,
                   const std::string& coder) {
    constexpr double max_steps = 16;
    const bool too_fine = outcome.error > max_steps * max_steps * step * step * outcome.samples;
    if (!too_fine && !(target.sqnr && outcome.sqnr() < *target.sqnr)) return;
    throw Error(ErrorCode::usage,
                fmt::format("{} asked for, finer than coder {} can be here: it would have {:.2f} dB; expected less, or "
                            "--lossless",
                            target.sqnr   ? fmt::format("an SQNR of {} dB was", *target.sqnr)
                            : target.step ? fmt::format("a step of {} was", *target.step)
                                          : fmt::format("{} pixels per bit were", *target.pixels_per_bit),
                            coder, outcome.sqnr()));
}

// The step of a prediction that makes tiles smallest, by halves and doubles from a likely one.
double smallest_step(const Compression& compression, const CompressionTarget& target) {
    constexpr int most = 8;
    double start = likely_step(target, target.lossless ? compression.try_middle(1).second : 0);
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
    if (!target.max_error) return coder_of_part(info, part);
    return coder_in_layout(info.layout, part, [counted = counted(info), error = *target.max_error](const auto& grid) {
        return make_bounded_coder(grid, counted, error);
    });
}

Companding mapping_for(std::span<const LightFieldSource* const> faces, const CompressionOptions& options,
                       const Progress& progress) {
    const CompressionTarget& target = options.target;
    Companding mapping;
    if (!options.tone_decades && options.chrominance == 1) return mapping;
    if (target.lossless || target.max_error)
        throw Error(ErrorCode::usage,
                    "a tone curve or coarser chrominance neither keep to an error nor are lossless; expected an SQNR, "
                    "a rate or a step");
    if (!(options.chrominance >= 1 && options.chrominance <= Companding::max_chrominance))
        throw Error(ErrorCode::usage, fmt::format("chrominance {} times as coarse was asked for, expected 1 to {}",
                                                  options.chrominance, Companding::max_chrominance));
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

    MappedFaces(std::span<const LightFieldSource* const> sources, const Companding& mapping)
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
    const core::StopScope scope(progress);
    check(options.target);
    const LightFieldGrid& grid = sources.front()->grid();
    const bool exact = options.target.lossless || options.target.max_error;
    if (exact && options.method != CodingMethod{})
        throw Error(ErrorCode::usage, fmt::format("coder {} cannot keep to an error, nor be lossless; expected hogel",
                                                  options.method.coder));
    require_perspective(grid, ErrorCode::usage, "a compressed light field");
    const Companding mapping = mapping_for(sources, options, progress);
    const MappedFaces mapped(sources, mapping);
    const std::span<const LightFieldSource* const> faces = mapped.faces;
    StreamInfo info{grid, {}, options.method, options.metadata};
    info.mapping = mapping;
    if (exact) info.method.coder = options.target.lossless ? "lossless" : "bounded";
    double pixels = 0;
    for (const LightFieldSource* face : faces) {
        if (face != faces.front()) info.sides.push_back(face->grid());
        pixels += static_cast<double>(face->grid().directions()) * static_cast<double>(grid.hogels());
    }
    const CoderOfFace coder_of = [&](const StreamInfo& stream, const LightFieldGrid& part) {
        return coder_for(stream, part, options.target);
    };
    info.layout = choose_layout(faces, info, options, coder_of);
    const std::vector<LightFieldGrid> grids = coded_parts(info);
    const auto unfolded = info.layout == StreamLayout::unfolded ? unfold(faces) : std::unique_ptr<LightFieldSource>{};
    std::vector<Compression::Part> parts;
    for (std::size_t i = 0; i < grids.size(); ++i)
        parts.push_back({unfolded ? unfolded.get() : faces[i], coder_of(info, grids[i])});
    info.tile = options.tile.value_or(parts.front().coder->preferred_tile(grids.front()));
    info.tile.ns = std::min(info.tile.ns, grid.hogels_s);
    info.tile.nt = std::min(info.tile.nt, grid.hogels_t);
    info.layer_ends.resize(parts.front().coder->layers(info.tile));
    std::optional<core::OutputFile> depth;
    if (options.with_depth) info.depth = compress_depth(sources, depth.emplace(path).temporary(), options);
    StreamWriter writer(path, info, depth ? depth->temporary() : std::filesystem::path());
    Compression compression(parts, info, writer, progress);
    const CompressionTarget& target = options.target;
    const std::vector<std::size_t> all = all_tiles(compression.tiles());

    CompressionResult result;
    CodingOutcome outcome;
    std::uint64_t filler = 0;
    if (target.step || exact) {
        result.step = exact ? smallest_step(compression, target) : *target.step;
        outcome = compression.code(all, result.step, true);
        result.passes = 1;
        if (target.step) check_quality(target, outcome, result.step, options.method.coder);
    } else {
        const std::vector<std::size_t> some = all.size() >= 3 * sampled ? some_tiles(all.size()) : all;
        const CodingOutcome seen = compression.look(some);
        const double likely = likely_step(target, std::sqrt(seen.signal / seen.samples));
        StepSearch search(likely > 0 ? std::log2(likely) : 0, [&](const CodingOutcome& o) {
            if (target.sqnr) return o.sqnr();
            const double overhead = static_cast<double>(writer.overhead(all.size()));
            return std::log2(o.bytes * (compression.samples() / o.samples) + overhead);
        });
        const auto code_some = [&](double step) { return compression.code(some, step, false); };
        const auto code_all = [&](double step) { return compression.code(all, step, true); };
        const double most =
            target.pixels_per_bit ? max_bytes(*target.pixels_per_bit, pixels, compression.samples()) : 0;
        const bool embedded = compression.embedded();
        const double room = std::max(most - (embedded ? 0 : static_cast<double>(min_filler)), 1.0);
        const auto band = [&](double tolerance) {
            return target.sqnr ? band_of_sqnr(*target.sqnr) : band_of_bytes(room, tolerance, embedded);
        };
        if (some.size() < all.size()) search.run(band(first_tolerance), code_some);
        const double tolerance =
            embedded ? first_tolerance : std::min(last_tolerance, static_cast<double>(max_filler) / most);
        const StepFound found = search.run(band(tolerance), code_all);
        outcome = search.outcome();
        result.step = search.step();
        result.passes = search.passes();
        if (!embedded || target.sqnr) check_quality(target, outcome, result.step, options.method.coder);
        if (target.pixels_per_bit) {
            if (embedded && static_cast<double>(writer.size()) > most) {
                outcome = compression.code(all, result.step, true, compression.cut(most));
                ++result.passes;
            }
            if (found == StepFound::only_below || static_cast<double>(writer.size()) > room)
                refuse_rate(*target.pixels_per_bit, most, writer.size());
            filler = std::min(static_cast<std::uint64_t>(most) - writer.size(), std::uint64_t{max_filler});
        }
    }
    result.bytes = writer.size() + filler;
    result.depth_bytes = info.depth.bytes;
    result.depth_error = info.depth.error;
    writer.finish(filler);
    result.sqnr = outcome.sqnr();
    result.pixels_per_bit = pixels / (8 * static_cast<double>(result.bytes));
    return result;
}

}  // namespace hogel
