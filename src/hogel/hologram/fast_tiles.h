// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/core/object_pool.h"
#include "hogel/hologram/direction_phases.h"
#include "hogel/hologram/frequency_grid.h"
#include "hogel/math/column_fft.h"

namespace hogel::hologram {

/// Phases and one FFT for hogels whose sides are powers of two. Sixteen rows of frequencies lie side by side, so that
/// phases and transforms along rows are those of whole vectors; they are transposed into a square that stays in
/// the cache, and the transforms of its columns write a hogel's samples where they are wanted.
class FastTiles {
  public:
    /// From 16 on, where this processor has vectors.
    static bool can(std::size_t side);

    /// @param phases  of each look, the same in all hogels; none: every hogel has random phases of its own
    FastTiles(std::size_t side, const DirectionPhases& phases);

    /// Moduli as synthesise() wants them: [hogel][row/16][column][row mod 16].
    void prepare(const FrequencyGrid& frequencies, View<const float, 2> values, bool of_roots,
                 View<float, 2> moduli) const;

    /// @param series  of random phases
    /// @param look    of the phases that all hogels have
    void synthesise(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, std::complex<float>* to,
                    std::size_t to_row) const;

  private:
    std::size_t side_;
    math::ColumnFft fft_;
    std::vector<Array<float, 1>> phases_;  // of each look: [row/16][column][part][row mod 16]
    mutable core::ObjectPool<Array<float, 1>>
        sixteens_;  // the same rows of sixteen hogels: [row mod 16][column][hogel]
};

}  // namespace hogel::hologram
