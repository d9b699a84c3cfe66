// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <span>

#include "hogel/math/fft.h"
#include "hogel/math/split_fft.h"
#include "hogel/stereogram/direction_phases.h"
#include "hogel/stereogram/fast_tiles.h"
#include "hogel/stereogram/hogel_synthesis.h"

namespace hogel::stereogram {

/// Computes amplitudes √L of radiances. Small negative radiances of decoded light fields count as zero.
void roots_of(View<const float, 2> radiances, View<float, 2> roots);

/// Synthesis by one FFT per hogel of amplitudes on the frequency grid j/d, with random or shared phases; for horizontal
/// parallax only by one FFT per line: [K] (4.2), (3.23).
class FourierSynthesis final : public HogelSynthesis, public HogelWaves {
  public:
    using Complex = std::complex<float>;

    /// @param lines       number per hogel, for horizontal parallax only; 0: a square with both parallaxes
    /// @param directions  phases shared by all hogels; empty: independent random phases for every hogel, or line
    FourierSynthesis(FrequencyGrid frequencies, std::size_t lines, const HologramOptions& options,
                     DirectionPhases directions, LobeAverage average);

    std::size_t prepared_size() const override { return frequencies_.coefficients(); }
    void prepare(View<const float, 2> radiances, View<const float, 2>, View<float, 2> prepared) const override;
    /// As prepare() with LobeAverage::amplitude, from amplitudes √L, which may be negative.
    void prepare_roots(View<const float, 2> roots, View<float, 2> prepared) const { prepare(roots, true, prepared); }

    /// Counts phases from the hogel's first sample. The factor i of [K] (4.2) is part of the phases.
    void synthesise(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> hogel) const override;
    void synthesise_to(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> scratch, Complex* to,
                       std::size_t to_stride) const override;

    const HogelWaves* hogel_waves() const override { return this; }
    void waves(std::span<const float> moduli, const HogelKey& key, const InBandRows& rows, float* waves) const override;
    void powers(std::span<const float> moduli, float* powers) const override;
    bool independent() const override { return directions_.empty() && lines_ == 0; }
    bool has_light(std::size_t row) const override { return lines_ > 0 || active_rows_[row]; }
    bool has_lanes() const override { return !middle_.empty() || (fast_ && fast_->has_lanes()); }
    SeriesOfLanes series_of_lanes(std::span<const HogelKey> keys) const override;
    void gather_lanes(std::span<const float* const> moduli, std::size_t row, float* gathered) const override;
    void row_of_lanes(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      float* waves) const override;

  private:
    void prepare(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const;
    void transform(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> values, Complex* to,
                   std::size_t to_stride) const;
    void spread_phases(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> values) const;
    void spread_lines(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> values) const;
    void transform_down(View<Complex, 2> values) const;

    HologramOptions options_;
    LobeAverage average_;
    FrequencyGrid frequencies_;
    std::vector<bool> active_rows_;
    std::size_t lines_;
    math::Fft2 fft_;
    std::optional<math::Fft1> down_;            // over the lines of a hogel
    std::optional<math::SplitFft> batch_down_;  // sixteen columns of down_, if it supports the number of lines
    DirectionPhases directions_;
    std::optional<FastTiles> fast_;  // if it supports the hogel's side
    std::vector<float> middle_;      // middle_phases(), for lanes that fast_ does not support
};

}  // namespace hogel::stereogram
