// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hogel/core/object_pool.h"
#include "hogel/math/column_fft.h"
#include "hogel/stereogram/direction_phases.h"
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/stereogram/hogel_tiles.h"
#include "hogel/stereogram/in_band_rows.h"

namespace hogel::stereogram {

/// Phases and one FFT for hogels whose sides are powers of two. Sixteen rows of frequencies lie side by side, so that
/// phases and transforms along rows are those of whole vectors; they are transposed into a square that stays in
/// the cache, and the transforms of its columns write a hogel's samples to their destination.
class FastTiles {
  public:
    /// Whether this side is supported: powers of two from 16 on, if the processor has vectors.
    static bool can(std::size_t side);

    /// @param phases  [look], shared by all hogels; empty: every hogel has its own random phases
    FastTiles(std::size_t side, const DirectionPhases& phases);

    /// Computes the moduli in the layout of synthesise(): [hogel][row/16][column][row mod 16].
    void prepare(const FrequencyGrid& frequencies, View<const float, 2> values, bool of_roots,
                 View<float, 2> moduli) const;

    /// @param series  of random phases
    /// @param look    for phases that all hogels share
    void synthesise(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, std::complex<float>* to,
                    std::size_t to_row) const;

    /// The waves that synthesise() transforms, as HogelWaves::waves().
    void waves(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, const InBandRows& rows,
               float* waves) const;

    /// Whether row_of_lanes() is supported: random phases of sides up to 128.
    bool has_lanes() const;
    /// See HogelWaves.
    void gather_lanes(std::span<const float* const> moduli, std::size_t row, float* gathered) const;
    void row_of_lanes(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      float* waves) const;

  private:
    // Sixteen rows of waves, [column][part][row].
    void sixteen_rows(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, std::size_t row,
                      float* waves) const;

    std::size_t side_;
    math::ColumnFft fft_;
    std::vector<Array<float, 1>> phases_;  // [look]: [row/16][column][part][row mod 16]
    mutable core::ObjectPool<Array<float, 1>>
        sixteens_;  // scratch for the rows of sixteen hogels: [row mod 16][column][hogel]
};

}  // namespace hogel::stereogram
