// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "hogel/hologram/direction_phases.h"
#include "hogel/hologram/fast_tiles.h"
#include "hogel/hologram/hogel_synthesis.h"

namespace hogel::hologram {
namespace {

using Complex = std::complex<float>;

class FourierSynthesis final : public HogelSynthesis, public HogelWaves {
  public:
    /// @param lines  number per hogel, for horizontal parallax only; 0: a square with both parallaxes
    FourierSynthesis(FrequencyGrid frequencies, std::size_t lines, const HologramOptions& options, Phases phases,
                     LobeAverage average)
        : options_(options),
          average_(average),
          frequencies_(std::move(frequencies)),
          lines_(lines),
          fft_(frequencies_.rows(), frequencies_.columns()) {
        if (phases != Phases::random)
            directions_ = direction_phases(frequencies_, fft_, options, phases == Phases::designed);
        if (lines == 0 && FastTiles::can(frequencies_.columns())) fast_.emplace(frequencies_.columns(), directions_);
    }

    std::size_t prepared_size() const override { return frequencies_.coefficients(); }

    void prepare(View<const float, 2> radiances, View<const float, 2>, View<float, 2> prepared) const override {
        if (average_ == LobeAverage::radiance) return prepare(radiances, false, prepared);
        Array<float, 2> roots(radiances.shape());
        for (std::size_t i = 0; i < roots.size(); ++i) roots.data()[i] = std::sqrt(std::max(radiances.data()[i], 0.0f));
        prepare(roots, true, prepared);
    }

    // Phases are counted from the hogel's first sample; the factor i of [K] (4.2) is part of them.
    void synthesise(std::span<const float> moduli, const HogelPlace& place, View<Complex, 2> hogel) const override {
        synthesise_to(moduli, place, hogel, hogel.data(), hogel.extent(1));
    }

    void synthesise_to(std::span<const float> moduli, const HogelPlace& place, View<Complex, 2> scratch, Complex* to,
                       std::size_t to_row) const override {
        if (fast_)
            return fast_->synthesise(moduli, phase_series(options_, place.s, place.t, place.look), place.look, to,
                                     to_row);
        if (lines_ == 0) return transform(moduli, place, scratch, to, to_row);
        if (!directions_.empty()) {
            transform(moduli, place, {scratch.data(), {1, frequencies_.columns()}}, to, to_row);
            return write_lines(options_, place, lines_, {to, frequencies_.columns()}, to, to_row);
        }
        // Lines are independent.
        for (std::size_t line = 0; line < lines_; ++line)
            transform(moduli, {place.s, place.t * lines_ + line, place.look},
                      {&scratch(line, 0), {1, frequencies_.columns()}}, to + line * to_row, to_row);
    }

    const HogelWaves* hogel_waves() const override { return lines_ == 0 ? this : nullptr; }

    void waves(std::span<const float> moduli, const HogelPlace& place, const NearRows& rows,
               float* waves) const override {
        const PhaseSeries series = phase_series(options_, place.s, place.t, place.look);
        if (fast_) return fast_->waves(moduli, series, place.look, rows, waves);
        const std::size_t n = frequencies_.columns();
        thread_local std::vector<Complex> plain;
        plain.resize(rows_together * n);
        for (std::size_t row = 0; row < n; row += rows_together) {
            if (!rows.has_any(row, rows_together, n)) continue;
            const View<Complex, 2> some(plain.data(), {std::min(rows_together, n - row), n});
            const std::size_t first = row * n;
            if (directions_.empty())
                spread_random_phases(series, moduli.subspan(first, some.size()), some.elements(),
                                     static_cast<std::uint32_t>(first / 16));
            else
                for (std::size_t i = 0; i < some.size(); ++i)
                    some.data()[i] = moduli[first + i] * directions_[place.look].data()[first + i];
            store_waves(some, row, waves);
        }
    }

    void powers(std::span<const float> moduli, float* powers) const override {
        const std::size_t n = frequencies_.columns();
        if (fast_) {  // moduli are in the same order
            for (std::size_t i = 0; i < moduli.size(); ++i) powers[i] = moduli[i] * moduli[i];
            return;
        }
        if (n % rows_together != 0) std::fill_n(powers, powers_size(n), 0.0f);
        for (std::size_t row = 0; row < n; ++row)
            for (std::size_t column = 0; column < n; ++column) {
                const float modulus = moduli[row * n + column];
                powers[(row / rows_together * n + column) * rows_together + row % rows_together] = modulus * modulus;
            }
    }

    bool independent() const override { return directions_.empty(); }

    bool has_lanes() const override { return fast_ && fast_->has_lanes(); }
    void gather_lanes(std::span<const float* const> moduli, std::size_t row, float* gathered) const override {
        fast_->gather_lanes(moduli, row, gathered);
    }
    SeriesOfLanes series_of_lanes(std::span<const HogelPlace> places) const override {
        SeriesOfLanes series{};
        for (std::size_t lane = 0; lane < places.size(); ++lane) {
            const PhaseSeries own = phase_series(options_, places[lane].s, places[lane].t, places[lane].look);
            series.key = own.key;
            for (std::size_t word = 0; word < 3; ++word) series.position[word][lane] = own.position[word];
        }
        return series;
    }
    void row_of_lanes(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                      float* waves) const override {
        fast_->row_of_lanes(series, row, shared, moduli, waves);
    }

  private:
    void prepare(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const {
        if (fast_)
            fast_->prepare(frequencies_, values, of_roots, moduli);
        else if (of_roots)
            frequencies_.amplitudes_of_roots(values, moduli);
        else
            frequencies_.amplitudes(values, moduli);
    }

    void transform(std::span<const float> moduli, const HogelPlace& place, View<Complex, 2> values, Complex* to,
                   std::size_t to_row) const {
        spread_phases(moduli, place, values);
        fft_.backward(values, to, to_row);
    }

    void spread_phases(std::span<const float> moduli, const HogelPlace& place, View<Complex, 2> values) const {
        if (directions_.empty()) {
            spread_random_phases(phase_series(options_, place.s, place.t, place.look), moduli, values.elements());
        } else {
            for (std::size_t i = 0; i < moduli.size(); ++i)
                values.data()[i] = moduli[i] * directions_[place.look].data()[i];
        }
    }

    HologramOptions options_;
    LobeAverage average_;
    FrequencyGrid frequencies_;
    std::size_t lines_;
    math::Fft2 fft_;
    DirectionPhases directions_;     // empty if every hogel has its own phases
    std::optional<FastTiles> fast_;  // if it supports this side of hogels
};

}  // namespace

std::unique_ptr<HogelSynthesis> make_fourier_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                       const HologramOptions& options, const Fourier& method) {
    return std::make_unique<FourierSynthesis>(faces.size() == 1
                                                  ? FrequencyGrid(faces.front(), samples, options.channel.wavelength)
                                                  : FrequencyGrid(faces, samples, options.channel.wavelength),
                                              0, options, method.phases, method.average);
}

std::unique_ptr<HogelSynthesis> make_line_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                    std::size_t lines, const HologramOptions& options,
                                                    const Lines& method) {
    return std::make_unique<FourierSynthesis>(
        FrequencyGrid::of_line(faces, samples, faces.front().pitch / static_cast<double>(lines),
                               options.channel.wavelength),
        lines, options, method.phases, method.average);
}

}  // namespace hogel::hologram
