// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/wave_cache.h"

#include <algorithm>
#include <cmath>

#include "hogel/core/half.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::hogel_spectra {
namespace {

// Order of the largest stored value of a tile. It leaves room for small values in the range of binary16.
constexpr float max_stored = 4096;

std::size_t tiles(std::size_t samples, std::size_t hop) { return (samples / hop + tile_side - 1) / tile_side; }

}  // namespace

std::size_t WaveCache::bytes(const HogelLayout& hogels) {
    const Grid& plane = hogels.grid.plane;
    return tiles(plane.width, hogels.across()) * tiles(plane.height, hogels.down()) * hogels.rows * hogels.columns * 2 *
           stereogram::HogelWaves::lanes * sizeof(std::uint16_t);
}

WaveCache::WaveCache(const HogelLayout& hogels, const stereogram::HogelWaves& waves, View<const float, 2> amplitudes)
    : across_(tiles(hogels.grid.plane.width, hogels.across())),
      down_(tiles(hogels.grid.plane.height, hogels.down())),
      rows_({across_ * down_, hogels.rows * hogels.columns * 2 * stereogram::HogelWaves::lanes}),
      active_({across_ * down_, hogels.rows}),
      scales_(across_ * down_) {
    const std::size_t ns = hogels.grid.plane.width / hogels.across(), nt = hogels.grid.plane.height / hogels.down();
    const std::size_t n = hogels.columns, row_size = n * 2 * stereogram::HogelWaves::lanes;
    work::parallel_for(down_, [&](std::size_t strip) {
        const std::size_t t0 = strip * tile_side;
        Array<float, 1> powers({stereogram::HogelWaves::powers_size(n) * stereogram::HogelWaves::lanes}),
            row_of_waves({row_size});
        for (std::size_t s0 = 0; s0 < ns; s0 += tile_side) {
            std::vector<const float*> sources;
            std::vector<stereogram::HogelKey> keys;
            float largest = 0;
            for (std::size_t t = t0; t < std::min(t0 + tile_side, nt); ++t)
                for (std::size_t s = s0; s < std::min(s0 + tile_side, ns); ++s) {
                    const std::span<const float> source = amplitudes[t * ns + s].elements();
                    sources.push_back(source.data());
                    keys.push_back({s, t, 0});
                    largest = std::max(largest, *std::ranges::max_element(source));
                }
            const std::size_t tile = strip * across_ + s0 / tile_side;
            scales_[tile] = largest > 0 ? std::exp2(std::ceil(std::log2(largest / max_stored))) : 1.0f;
            const stereogram::SeriesOfLanes series = waves.series_of_lanes(keys);
            for (std::size_t row = 0; row < hogels.rows; ++row) {
                if (row % stereogram::HogelWaves::block_rows == 0) waves.gather_lanes(sources, row, powers.data());
                if (!waves.has_light(row)) continue;
                waves.row_of_lanes(series, row, false, powers.data(), row_of_waves.data());
                for (float& value : row_of_waves.elements()) value /= scales_[tile];
                active_(tile, row) =
                    std::ranges::any_of(row_of_waves.elements(), [](float value) { return value != 0; });
                core::to_half(row_of_waves.data(), &rows_(tile, row * row_size), row_size);
            }
        }
    });
}

}  // namespace hogel::camera::hogel_spectra
