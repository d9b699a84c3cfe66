// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hogel/array.h"
#include "hogel/camera/hogel_spectra/pupil_band.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::camera::hogel_spectra {

/// Hogels along a side of a tile, which share vectors: sixteen, one for each lane, or fewer at the borders.
inline constexpr std::size_t tile_side = 4;
static_assert(tile_side * tile_side == stereogram::HogelWaves::lanes);

/// The waves of all hogels for some looks, so that eyes that are drawn one after the other need not make them again: in
/// binary16, which is 5·10⁻⁴ exact, tile by tile with hogels as lanes, and phases counted from the middle of each
/// hogel.
class KeptWaves {
  public:
    /// @param amplitudes  of all hogels, row by row, as `waves` prepares them
    KeptWaves(const HogelLayout& hogels, const stereogram::HogelWaves& waves, View<const float, 2> amplitudes);

    static std::size_t bytes(const HogelLayout& hogels);

    struct Tile {
        const std::uint16_t* rows = nullptr;   ///< [row][column][part][lane]; null if they are not kept
        const std::uint8_t* active = nullptr;  ///< [row]: whether it has any light
        float scale = 1;                       ///< of all values
    };
    /// The tile whose first hogel is (s, t), multiples of tile_side.
    Tile tile(std::size_t s, std::size_t t) const {
        const std::size_t number = t / tile_side * across_ + s / tile_side;
        return {&rows_(number, 0), &active_(number, 0), scales_[number]};
    }

  private:
    std::size_t across_, down_;      // tiles
    Array<std::uint16_t, 2> rows_;   // [tile][row, column, part, lane]
    Array<std::uint8_t, 2> active_;  // [tile][row]
    std::vector<float> scales_;      // [tile]
};

}  // namespace hogel::camera::hogel_spectra
