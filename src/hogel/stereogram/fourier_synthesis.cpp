// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/fourier_synthesis.h"
#include "hogel/core/thread_buffer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hogel::stereogram {
namespace {

// Moduli of sixteen larger hogels side by side exceed the L2 cache.
constexpr std::size_t max_side_in_lanes = 256;

}  // namespace

void roots_of(View<const float, 2> radiances, View<float, 2> roots) {
    for (std::size_t i = 0; i < radiances.size(); ++i) roots.data()[i] = std::sqrt(std::max(radiances.data()[i], 0.0f));
}

FourierSynthesis::FourierSynthesis(FrequencyGrid frequencies, std::size_t lines, const HologramOptions& options,
                                   DirectionPhases directions, LobeAverage average)
    : options_(options),
      average_(average),
      frequencies_(std::move(frequencies)),
      active_rows_(frequencies_.active_rows()),
      lines_(lines),
      fft_(frequencies_.rows(), frequencies_.columns()),
      directions_(std::move(directions)) {
    if (lines > 0) down_.emplace(lines);
    if (lines > 0 && math::good_fft_size(lines) == lines) batch_down_.emplace(lines);
    if (lines == 0 && FastTiles::can(frequencies_.columns())) fast_.emplace(frequencies_.columns(), directions_);
    const std::size_t n = frequencies_.columns();
    if (independent() && !has_lanes() && n >= rows_at_once && n <= max_side_in_lanes) middle_ = middle_phases(n);
}

void FourierSynthesis::prepare(View<const float, 2> radiances, View<const float, 2>, View<float, 2> prepared) const {
    if (average_ == LobeAverage::radiance) return prepare(radiances, false, prepared);
    Array<float, 2> roots(radiances.shape());
    roots_of(radiances, roots);
    prepare(roots, true, prepared);
}

void FourierSynthesis::prepare(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const {
    if (fast_)
        fast_->prepare(frequencies_, values, of_roots, moduli);
    else if (of_roots)
        frequencies_.amplitudes_of_roots(values, moduli);
    else
        frequencies_.amplitudes(values, moduli);
}

void FourierSynthesis::synthesise(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> hogel) const {
    synthesise_to(moduli, key, hogel, hogel.data(), hogel.extent(1));
}

void FourierSynthesis::synthesise_to(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> scratch,
                                     Complex* to, std::size_t to_stride) const {
    if (fast_)
        return fast_->synthesise(moduli, phase_series(options_, key.s, key.t, key.look), key.look, to, to_stride);
    if (lines_ == 0) return transform(moduli, key, scratch, to, to_stride);
    if (!directions_.empty()) {
        transform(moduli, key, {scratch.data(), {1, frequencies_.columns()}}, to, to_stride);
        return write_lines(options_, key, lines_, {to, frequencies_.columns()}, to, to_stride);
    }
    // Lines are independent.
    for (std::size_t line = 0; line < lines_; ++line)
        transform(moduli, {key.s, key.t * lines_ + line, key.look}, {&scratch(line, 0), {1, frequencies_.columns()}},
                  to + line * to_stride, to_stride);
}

void FourierSynthesis::waves(std::span<const float> moduli, const HogelKey& key, const InBandRows& rows,
                             float* waves) const {
    const PhaseSeries series = phase_series(options_, key.s, key.t, key.look);
    if (fast_) return fast_->waves(moduli, series, key.look, rows, waves);
    const std::size_t n = frequencies_.columns();
    const Shape<2> shape{lines_ > 0 ? lines_ : n, n};
    const core::ThreadBuffer<Complex> buffer(shape[0] * shape[1]);
    const View<Complex, 2> plain(buffer.data(), shape);
    if (lines_ > 0)
        spread_lines(moduli, key, plain);
    else
        spread_phases(moduli, key, plain);
    store_waves(plain, rows, waves);
}

void FourierSynthesis::powers(std::span<const float> moduli, float* powers) const {
    const std::size_t n = frequencies_.columns();
    if (fast_) {  // moduli have the same order
        for (std::size_t i = 0; i < moduli.size(); ++i) powers[i] = moduli[i] * moduli[i];
        return;
    }
    if (n % block_rows != 0) std::fill_n(powers, powers_size(n), 0.0f);
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column) {
            const float modulus = moduli[row * n + column];
            powers[(row / block_rows * n + column) * block_rows + row % block_rows] = modulus * modulus;
        }
}

SeriesOfLanes FourierSynthesis::series_of_lanes(std::span<const HogelKey> keys) const {
    SeriesOfLanes series{};
    for (std::size_t lane = 0; lane < keys.size(); ++lane) {
        const PhaseSeries lane_series = phase_series(options_, keys[lane].s, keys[lane].t, keys[lane].look);
        series.key = lane_series.key;
        for (std::size_t word = 0; word < 3; ++word) series.position[word][lane] = lane_series.position[word];
    }
    return series;
}

void FourierSynthesis::gather_lanes(std::span<const float* const> moduli, std::size_t row, float* gathered) const {
    if (fast_) return fast_->gather_lanes(moduli, row, gathered);
    const std::size_t n = frequencies_.columns();
    for (std::size_t end = std::min(row + block_rows, n); row < end; ++row)
        for (std::size_t x = 0; x < n && active_rows_[row]; x += rows_at_once) {
            const std::size_t index = row * n + std::min(x, n - rows_at_once);
            gather_rows(moduli, index, gathered + index * rows_at_once, rows_at_once);
        }
}

void FourierSynthesis::row_of_lanes(const SeriesOfLanes& series, std::size_t row, bool shared, const float* moduli,
                                    float* waves) const {
    if (middle_.empty()) return fast_->row_of_lanes(series, row, shared, moduli, waves);
    const std::size_t n = frequencies_.columns();
    if (!shared)
        moduli += row * n * rows_at_once;
    else if (fast_)
        moduli += row / rows_at_once * rows_at_once * n + row % rows_at_once;
    else
        moduli += row * n;
    random_row_of_any_side(series, row, shared, moduli, shared && !fast_ ? 1 : rows_at_once, middle_, n, waves);
}

void FourierSynthesis::transform(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> values,
                                 Complex* to, std::size_t to_stride) const {
    spread_phases(moduli, key, values);
    fft_.backward(values, to, to_stride);
}

void FourierSynthesis::spread_phases(std::span<const float> moduli, const HogelKey& key,
                                     View<Complex, 2> values) const {
    if (directions_.empty()) {
        spread_random_phases(phase_series(options_, key.s, key.t, key.look), moduli, values.elements());
    } else {
        for (std::size_t i = 0; i < moduli.size(); ++i) values.data()[i] = moduli[i] * directions_[key.look].data()[i];
    }
}

// Computes the waves of a square of lines: those of each line, transformed over the lines.
void FourierSynthesis::spread_lines(std::span<const float> moduli, const HogelKey& key, View<Complex, 2> values) const {
    const std::size_t n = frequencies_.columns();
    if (directions_.empty()) {
        for (std::size_t line = 0; line < lines_; ++line)
            spread_phases(moduli, {key.s, key.t * lines_ + line, key.look}, {&values(line, 0), {1, n}});
    } else {
        spread_phases(moduli, key, {values.data(), {1, n}});
        write_lines(options_, key, lines_, {values.data(), n}, values.data(), n);
    }
    transform_down(values);
}

// Transforms the waves over the lines. Divides by the number of lines: a backward transform restores them.
void FourierSynthesis::transform_down(View<Complex, 2> values) const {
    const std::size_t n = values.extent(1);
    const float share = 1 / static_cast<float>(lines_);
    if (!batch_down_) {
        const core::ThreadBuffer<Complex> column(lines_);
        for (std::size_t x = 0; x < n; ++x) {
            for (std::size_t line = 0; line < lines_; ++line) column[line] = values(line, x);
            down_->forward(column.data());
            for (std::size_t row = 0; row < lines_; ++row) values(row, x) = share * column[row];
        }
        return;
    }
    constexpr std::size_t batch = math::SplitFft::together, stride = math::SplitFft::row;
    const core::ThreadBuffer<float> columns(lines_ * stride);
    for (std::size_t x = 0; x < n; x += batch) {
        const std::size_t count = std::min(batch, n - x);
        for (std::size_t line = 0; line < lines_; ++line) {
            float* to = columns.data() + line * stride;
            for (std::size_t i = 0; i < count; ++i) {
                to[i] = values(line, x + i).real();
                to[batch + i] = values(line, x + i).imag();
            }
        }
        batch_down_->transform(columns.data());
        for (std::size_t row = 0; row < lines_; ++row) {
            const float* from = columns.data() + batch_down_->place(row) * stride;
            for (std::size_t i = 0; i < count; ++i) values(row, x + i) = {share * from[i], share * from[batch + i]};
        }
    }
}

namespace {

std::unique_ptr<HogelSynthesis> make(FrequencyGrid frequencies, std::size_t lines, const HologramOptions& options,
                                     Phases phases, LobeAverage average) {
    DirectionPhases directions;
    if (phases != Phases::random)
        directions = direction_phases(frequencies, math::Fft2(frequencies.rows(), frequencies.columns()), options,
                                      phases == Phases::designed);
    return std::make_unique<FourierSynthesis>(std::move(frequencies), lines, options, std::move(directions), average);
}

}  // namespace

std::unique_ptr<HogelSynthesis> make_fourier_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                       const HologramOptions& options, const Fourier& method) {
    return make(faces.size() == 1 ? FrequencyGrid(faces.front(), samples, options.channel.wavelength)
                                  : FrequencyGrid(faces, samples, options.channel.wavelength),
                0, options, method.phases, method.average);
}

std::unique_ptr<HogelSynthesis> make_line_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                    std::size_t lines, const HologramOptions& options,
                                                    const Lines& method) {
    return make(FrequencyGrid::of_line(faces, samples, faces.front().pitch / static_cast<double>(lines),
                                       options.channel.wavelength),
                lines, options, method.phases, method.average);
}

}  // namespace hogel::stereogram
