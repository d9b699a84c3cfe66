// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hogel/core/thread_buffer.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/stereogram/plane_wave_sum.h"
#include "hogel/stereogram/surface_cells.h"

namespace hogel::stereogram {
namespace {

using Complex = std::complex<float>;

// Each ray becomes a plane wave. If the ray meets a surface at Q, the wave travels along the line from Q to the hogel's
// centre and has there the phase of a spherical wave from Q. Otherwise it keeps its direction and has a random phase.
// The amplitude follows from the ray's solid angle, |a|² = L ΔU ΔV cos³θ; the sum over rays equals the sum over the
// lobes of a frequency grid (docs/notation.md, section 3).
class PhaseAddedSynthesis final : public HogelSynthesis, public HogelWaves {
  public:
    PhaseAddedSynthesis(const LightFieldGrid& light_field, std::size_t samples, const HologramOptions& options,
                        bool exact)
        : light_field_(light_field),
          wavelength_(options.channel.wavelength),
          samples_(samples),
          pitch_(light_field.pitch / static_cast<double>(samples)),
          cells_(light_field.step_u(), light_field.step_v(), options.seed, options.channel.index),
          reference_cosine_(1 / std::sqrt(1 + light_field.center_u() * light_field.center_u() +
                                          light_field.center_v() * light_field.center_v())),
          shallowest_(std::max(SurfaceCells::shallowest,
                               light_field.pitch / (4 * std::max(light_field.half_u(), light_field.half_v())))),
          fft_(samples, samples) {
        if (exact) waves_.emplace(samples);
        for (std::size_t l = 0; l < light_field.directions_v; ++l)
            for (std::size_t k = 0; k < light_field.directions_u; ++k) {
                const double U = light_field.u(static_cast<double>(k)), V = light_field.v(static_cast<double>(l));
                const double cosine = 1 / std::sqrt(1 + U * U + V * V);
                shares_.push_back(
                    static_cast<float>(light_field.step_u() * light_field.step_v() * cosine * cosine * cosine));
            }
    }

    std::size_t prepared_size() const override { return 2 * light_field_.directions(); }

    void prepare(View<const float, 2> radiances, View<const float, 2> depths, View<float, 2> prepared) const override {
        const std::size_t rays = radiances.extent(1);
        for (std::size_t hogel = 0; hogel < radiances.extent(0); ++hogel) {
            for (std::size_t i = 0; i < rays; ++i)
                prepared(hogel, i) = std::sqrt(std::max(radiances(hogel, i), 0.0f) * shares_[i]);
            std::copy_n(&depths(hogel, 0), rays, &prepared(hogel, rays));
        }
    }

    void synthesise(std::span<const float> prepared, const HogelKey& key, View<Complex, 2> hogel) const override {
        if (waves_) {
            Array<Complex, 2> spectrum = waves_->make_spectrum();
            for_each_wave(prepared, key,
                          [&](float amplitude, const Wave& wave) { add_exactly(amplitude, wave, spectrum); });
            waves_->transform(spectrum, hogel);
            return;
        }
        spread(prepared, key, hogel);
        fft_.backward(hogel);
    }

    // With exact frequencies a hogel is not a sum of as many waves as samples.
    const HogelWaves* hogel_waves() const override { return waves_ ? nullptr : this; }

    void waves(std::span<const float> prepared, const HogelKey& key, const InBandRows& rows,
               float* waves) const override {
        const core::ThreadBuffer<Complex> buffer(samples_ * samples_);
        const View<Complex, 2> spectrum(buffer.data(), {samples_, samples_});
        spread(prepared, key, spectrum);
        store_waves(spectrum, rows, waves);
    }

  private:
    struct Wave {
        double columns, rows;  // frequency in cycles per sample, along a row and down a column
        double cycles;         // phase at the hogel's centre
        double share;          // of the ray's amplitude
    };

    // Computes the waves on the frequencies of the hogel's transform.
    void spread(std::span<const float> prepared, const HogelKey& key, View<Complex, 2> spectrum) const {
        std::ranges::fill(spectrum.elements(), Complex(0));
        for_each_wave(prepared, key, [&](float amplitude, const Wave& wave) { add(amplitude, wave, spectrum); });
    }

    template <class Use>
    void for_each_wave(std::span<const float> prepared, const HogelKey& key, const Use& use) const {
        const float* amplitudes = prepared.data();
        const float* depths = amplitudes + light_field_.directions();
        const double s = light_field_.s(static_cast<double>(key.s)), t = light_field_.t(static_cast<double>(key.t));
        for (std::size_t l = 0; l < light_field_.directions_v; ++l)
            for (std::size_t k = 0; k < light_field_.directions_u; ++k, ++amplitudes, ++depths) {
                if (*amplitudes == 0) continue;
                const Wave wave = wave_of(k, l, *depths, s, t, key.look);
                use(static_cast<float>(*amplitudes * wave.share), wave);
            }
    }

    Wave wave_of(std::size_t k, std::size_t l, double depth, double s, double t, std::size_t look) const {
        double U = light_field_.u(static_cast<double>(k)), V = light_field_.v(static_cast<double>(l));
        double cycles = 0, share = 1;
        if (std::isfinite(depth)) {
            // One hogel sees each cell; the depth only separates the cells of its rays.
            if (std::abs(depth) < shallowest_) depth = shallowest_;
            const SurfaceCell cell = cells_.find(s + U * depth, t + V * depth, depth, look);
            share = 1 / std::sqrt(cell.crowding);
            U = (cell.x - s) / cell.depth;
            V = (cell.y - t) / cell.depth;
            // The cell's phase refers to the hologram plane along the middle of the fan. Depth then enters by defocus
            // only, and a tilted or inexact surface shines as an even one.
            cycles = cell.cycles + cell.depth * (std::sqrt(1 + U * U + V * V) - reference_cosine_) / wavelength_;
        } else {
            // Rays without a surface: as rays to a distant one, with different cells for neighbouring hogels.
            cycles = cells_.find(s + U, t + V, 1.0, look).cycles;
        }
        const double to_frequency = pitch_ / (wavelength_ * std::sqrt(1 + U * U + V * V));
        return {-U * to_frequency, V * to_frequency, cycles, share};
    }

    // Returns whether the pitch cannot sample a wave (from a cell at the border of the field of view).
    static bool is_aliased(const Wave& wave) { return std::abs(wave.columns) > 0.5 || std::abs(wave.rows) > 0.5; }

    static Complex at_phase(float amplitude, double cycles) {
        const auto angle = static_cast<float>(2 * std::numbers::pi * (cycles - std::round(cycles)));
        return {amplitude * std::cos(angle), amplitude * std::sin(angle)};
    }

    void add_exactly(float amplitude, const Wave& wave, View<Complex, 2> spectrum) const {
        if (is_aliased(wave)) return;
        waves_->add(at_phase(amplitude, wave.cycles), wave.columns, wave.rows, spectrum);
    }

    void add(float amplitude, const Wave& wave, View<Complex, 2> spectrum) const {
        const auto n = static_cast<double>(samples_);
        const double column = std::round(wave.columns * n), row = std::round(wave.rows * n);
        const double max_index = std::floor(0.5 * (n - 1));
        if (std::abs(column) > max_index || std::abs(row) > max_index) return;
        const double first = -0.5 * (n - 1);  // first sample relative to the centre
        const double cycles = wave.cycles + (column + row) * first / n;
        spectrum(static_cast<std::size_t>(row < 0 ? row + n : row),
                 static_cast<std::size_t>(column < 0 ? column + n : column)) += at_phase(amplitude, cycles);
    }

    LightFieldGrid light_field_;
    double wavelength_;
    std::size_t samples_;
    double pitch_;
    SurfaceCells cells_;
    double reference_cosine_;  // cos θ in the middle of the fan of directions
    double shallowest_;        // metres; smaller depths count as this one
    math::Fft2 fft_;
    std::optional<PlaneWaveSum> waves_;  // with exact frequencies only
    std::vector<float> shares_;          // [direction]: ΔU ΔV cos³θ
};

}  // namespace

std::unique_ptr<HogelSynthesis> make_phase_added_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                           const HologramOptions& options, bool exact) {
    return std::make_unique<PhaseAddedSynthesis>(light_field, samples, options, exact);
}

}  // namespace hogel::stereogram
