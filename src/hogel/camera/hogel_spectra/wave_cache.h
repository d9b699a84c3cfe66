// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera/hogel_spectra/pupil_band.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::camera::hogel_spectra {

/// Hogels along a side of a tile, the sixteen lanes of vectors; there are fewer at the borders.
inline constexpr std::size_t tile_side = 4;
static_assert(tile_side * tile_side == stereogram::HogelWaves::lanes);

/// Cache of the waves of all hogels for the first look, for later viewpoints. Waves are stored tile by tile in binary16
/// (relative error 5·10⁻⁴), with hogels as lanes, and phases counted from the middle of each hogel.
class WaveCache {
  public:
    /// @param amplitudes  of all hogels in row-major order, as `waves` prepares them
    WaveCache(const HogelLayout& hogels, const stereogram::HogelWaves& waves, View<const float, 2> amplitudes);

    static std::size_t bytes(const HogelLayout& hogels);

    struct Tile {
        const std::uint16_t* rows = nullptr;   ///< [row][column][part][lane]; null: not cached
        const std::uint8_t* active = nullptr;  ///< [row]: whether a wave is not zero
        float scale = 1;                       ///< factor of all values
    };
    /// Returns the tile with the first hogel (s, t), multiples of tile_side.
    Tile tile(std::size_t s, std::size_t t) const {
        const std::size_t index = t / tile_side * across_ + s / tile_side;
        return {&rows_(index, 0), &active_(index, 0), scales_[index]};
    }

  private:
    std::size_t across_, down_;      // tiles
    Array<std::uint16_t, 2> rows_;   // [tile][row, column, part, lane]
    Array<std::uint8_t, 2> active_;  // [tile][row]
    std::vector<float> scales_;      // [tile]
};

}  // namespace hogel::camera::hogel_spectra
