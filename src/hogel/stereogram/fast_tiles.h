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

/// Synthesis by one FFT of hogels with sides of powers of two. Sixteen rows of frequencies lie side by side, so phases
/// and row transforms work on whole vectors. The rows are transposed into a square that stays in cache; its column
/// transforms write a hogel's samples to their destination. Thread-safe.
class FastTiles {
  public:
    /// Returns whether a side is supported: powers of two from 16 up, if the processor has vectors.
    static bool can(std::size_t side);

    /// @param phases  [look], shared by all hogels; empty: independent random phases for every hogel
    FastTiles(std::size_t side, const DirectionPhases& phases);

    /// Computes the moduli of the DFT coefficients of several hogels, as FrequencyGrid::amplitudes(), for synthesise():
    /// [hogel][row/16][column][row mod 16].
    /// @param values    [hogel][ray], radiances L
    /// @param of_roots  true: `values` are amplitudes √L
    void prepare(const FrequencyGrid& frequencies, View<const float, 2> values, bool of_roots,
                 View<float, 2> moduli) const;

    /// Computes the samples of a hogel, with row y at to + y·to_stride.
    /// @param moduli  of prepare()
    /// @param series  random phases of the hogel
    /// @param look    index of shared phases
    void synthesise(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, std::complex<float>* to,
                    std::size_t to_stride) const;

    /// As HogelWaves::waves(): the waves that synthesise() transforms.
    void waves(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, const InBandRows& rows,
               float* waves) const;

    /// Returns whether row_of_lanes() is supported: random phases, sides up to 128.
    bool has_lanes() const;
    /// See HogelWaves.
    void gather_lanes(std::span<const float* const> moduli, std::size_t row, float* gathered) const;
    void row_of_lanes(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      float* waves) const;

  private:
    // Computes sixteen rows of waves, [column][part][row].
    void sixteen_rows(std::span<const float> moduli, const PhaseSeries& series, std::size_t look, std::size_t row,
                      float* waves) const;

    std::size_t side_;
    math::ColumnFft fft_;
    std::vector<Array<float, 1>> phases_;                    // [look]: [row/16][column][part][row mod 16]
    mutable core::ObjectPool<Array<float, 1>> row_buffers_;  // scratch of prepare(): [row mod 16][column][hogel]
};

}  // namespace hogel::stereogram
