// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/tile_compression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hogel/codec/format/block_kernels.h"
#include "hogel/codec/tile_coder.h"
#include "hogel/error.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

// Returns sizes with a sum of `budget` bytes: each is `min_size` plus the same fraction of its excess over `min_size`.
std::vector<std::size_t> cut_sizes(const std::vector<std::size_t>& sizes, std::size_t min_size, double budget) {
    std::size_t total_excess = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}) - min_size * sizes.size();
    auto bytes = static_cast<std::size_t>(std::max(budget - static_cast<double>(min_size * sizes.size()), 0.0));
    std::vector<std::size_t> result;
    for (const std::size_t size : sizes) {
        const std::size_t excess = size - min_size;
        const double reduced = total_excess > 0 ? static_cast<double>(bytes) * static_cast<double>(excess) /
                                                      static_cast<double>(total_excess)
                                                : 0;
        result.push_back(min_size + static_cast<std::size_t>(reduced));
        total_excess -= excess;
        bytes -= result.back() - min_size;
    }
    return result;
}

}  // namespace

LightFieldTile SpareTiles::take(const LightFieldGrid& grid, const HogelRange& range) {
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

void SpareTiles::give_back(LightFieldTile tile) {
    const std::lock_guard lock(mutex_);
    tiles_.push_back(std::move(tile));
}

double TileCompression::samples() const {
    double sum = 0;
    for (const CodedPart& part : parts_) sum += part.source->grid().samples();
    return sum;
}

CodingOutcome TileCompression::code(std::span<const std::size_t> tiles, double step, bool write,
                                    std::span<const std::size_t> max_bytes) {
    if (write) {
        writer_.restart();
        sizes_.clear();
    }
    CodingOutcome sum;
    const work::Sent<Coded> sent{[](work::MessageWriter& to, const Coded& coded) {
                                     to.put(coded.bytes);
                                     to.put(coded.layers);
                                     to.put(coded.outcome);
                                 },
                                 [](work::MessageReader& from) {
                                     Coded coded;
                                     coded.bytes = from.get_vector<std::uint8_t>();
                                     coded.layers = from.get_vector<std::size_t>();
                                     coded.outcome = from.get<CodingOutcome>();
                                     return coded;
                                 }};
    work::ordered_reduce<Coded>(
        tiles.size(), in_flight(), sent,
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
    work::broadcast_result(sum, {});
    if (write) {
        writer_.share_entries();
        work::broadcast_result(sizes_, work::sent_vector<std::size_t>());
    }
    return sum;
}

CodingOutcome TileCompression::look(std::span<const std::size_t> tiles) {
    CodingOutcome sum;
    work::ordered_reduce<CodingOutcome>(
        tiles.size(), in_flight(), {},
        [&](std::size_t i) {
            auto [tile, outcome] = read(tiles[i]);
            spare_.give_back(std::move(tile));
            return outcome;
        },
        [&](std::size_t, CodingOutcome& outcome) { sum.add(outcome); });
    work::broadcast_result(sum, {});
    return sum;
}

coding::MagnitudeHistogram TileCompression::magnitudes() {
    std::vector<const CountsMagnitudes*> counters;
    for (const CodedPart& part : parts_) {
        counters.push_back(dynamic_cast<const CountsMagnitudes*>(part.coder.get()));
        if (!counters.back())
            throw Error(ErrorCode::usage, "rule",
                        "a rate by the rule of a histogram was asked for; expected coder threepass or fringes, and "
                        "another layout than stacked");
    }
    coding::MagnitudeHistogram sum;
    const work::Sent<coding::MagnitudeHistogram> sent{
        [](work::MessageWriter& to, const coding::MagnitudeHistogram& histogram) {
            to.put(histogram.max());
            to.put(histogram.counts());
        },
        [](work::MessageReader& from) {
            const auto max = from.get<float>();
            return coding::MagnitudeHistogram(max, from.get_vector<std::uint64_t>());
        }};
    work::ordered_reduce<coding::MagnitudeHistogram>(
        tiles(), in_flight(), sent,
        [&](std::size_t i) {
            auto [tile, outcome] = read(i);
            coding::MagnitudeHistogram histogram = counters[i / tiling_.count()]->magnitudes(tile);
            spare_.give_back(std::move(tile));
            return histogram;
        },
        [&](std::size_t i, const coding::MagnitudeHistogram& histogram) {
            sum.add(histogram);
            progress_.report(static_cast<double>(i + 1) / static_cast<double>(tiles()));
        });
    work::broadcast_result(sum, sent);
    return sum;
}

std::pair<double, double> TileCompression::try_middle(double step) const {
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

std::vector<std::size_t> TileCompression::cut(double file) const {
    const double budget = file - static_cast<double>(writer_.overhead(sizes_.size()));
    return cut_sizes(sizes_, *parts_.front().coder->min_bytes(parts_.front().source->grid()), budget);
}

std::size_t TileCompression::in_flight() const {
    return std::min(work::default_in_flight(), parts_.front().coder->max_at_once());
}

std::pair<LightFieldTile, CodingOutcome> TileCompression::read(std::size_t index) const {
    return read(parts_[index / tiling_.count()], tiling_[index % tiling_.count()]);
}

std::pair<LightFieldTile, CodingOutcome> TileCompression::read(const CodedPart& part, const HogelRange& range) const {
    LightFieldTile tile = spare_.take(part.source->grid(), range);
    part.source->read(tile);
    CodingOutcome outcome;
    const bool any_value = part.coder->takes_any_value();
    const std::size_t width = tile.radiance.extent(4), height = tile.radiance.extent(3);
    std::vector<double> signal(tile.radiance.size() / (width * height));  // of each hogel and channel
    work::parallel_for(signal.size(), [&](std::size_t hogel) {
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

TileCompression::Coded TileCompression::code_tile(std::size_t index, double step, std::size_t max_bytes) const {
    auto [tile, outcome] = read(index);
    TileCoder::Encoded encoded = parts_[index / tiling_.count()].coder->encode(tile, step, max_bytes);
    spare_.give_back(std::move(tile));
    outcome.error = encoded.squared_error;
    outcome.bytes = static_cast<double>(encoded.bytes.size());
    return {std::move(encoded.bytes), std::move(encoded.layers), outcome};
}

}  // namespace hogel::codec::encode
