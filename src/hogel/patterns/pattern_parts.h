// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <complex>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hogel/math/fft.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/pattern.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {

/// Returns the sum of of_line(i) over all lines, added in order: the same for any number of threads.
template <class OfLine>
auto sum_of_lines(std::size_t count, const OfLine& of_line) {
    std::vector<decltype(of_line(count))> lines(count);
    work::parallel_for(count, [&](std::size_t i) { lines[i] = of_line(i); });
    decltype(of_line(count)) sum{};
    for (const auto& line : lines) sum += line;
    return sum;
}

/// Rounds values, phases in cycles or amplitudes, to the numbers of a modulator's levels. Levels of modulators with
/// less than 256 are spread over 0 to 255, as displays of 8 bits expect them.
struct Rounding {
    unsigned levels;
    bool phases;
    PhaseCode code;

    std::uint16_t operator()(float value) const;
    std::uint16_t largest() const { return static_cast<std::uint16_t>(std::max(levels, 256u) - 1); }
};

/// Carrier wave e^{2πi f_x·column}, by column. The useful order of a pattern is F times the carrier.
using Carrier = std::vector<std::complex<float>>;

/// Returns half the width of the band along x, cycles per sample, that contains 95 % of a field's energy. Hogel edges
/// scatter the rest.
double band_along_x(View<const std::complex<float>, 2> field);

/// Diffraction order of an amplitude pattern that reproduces F.
struct CarriedOrder {
    Carrier carrier;
    double frequency = 0;  ///< of the reference wave, cycles per sample; the order is at -frequency along x
    double angle = 0;      ///< of the reference wave, radians
    double clearance = 0;  ///< from the middle of the order to the nearest other light, cycles per sample
};

/// Encodes a field F, |F| ≤ 1, as the pattern of an amplitude modulator, with values in [0, 1], by options.encoding.
/// Sets `order` to the diffraction order that reproduces F. Throws Error(usage) if diffraction orders would overlap.
Array<float, 2> encode_amplitude(View<const std::complex<float>, 2> field, const PatternOptions& options,
                                 double wavelength, CarriedOrder& order);

/// Returns the field's aperture, moved to the order, with a radius of at most order.clearance/1.1.
Aperture aperture_around(const CarriedOrder& order, Aperture of_field);

/// Computes the phases of a pattern for Encoding::gerchberg_saxton, in cycles [0, 1), by alternating projections in
/// squares of the field.
Array<float, 2> iterate_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// Number of iterations that computed a phase pattern, and its correlation with the field.
struct Convergence {
    std::size_t iterations = 0;
    double correlation = 0;  ///< behind the aperture, before rounding to levels
};

class FieldBand;

/// Computes the phases of a pattern for Encoding::gradient, in cycles [0, 1), by descent of FieldBand's error. Stops
/// when the correlation with the field stops rising, or after options.iterations steps (0: max_descent_steps). Stores
/// the number of steps and the final correlation in `convergence`.
Array<float, 2> descend_phases(View<const std::complex<float>, 2> field, const FieldBand& band,
                               const PatternOptions& options, Convergence& convergence, const Progress& progress);
/// Numbers of iterations if PatternOptions::iterations is 0: of alternating projections, and the limit of a descent.
inline constexpr std::size_t projections = 40, max_descent_steps = 200;

/// Band of a field (see Pattern::aperture): 1.1 times the aperture's radius, at most 0.4 cycles per sample.
class FieldBand {
  public:
    explicit FieldBand(View<const std::complex<float>, 2> field);

    const Aperture& aperture() const { return aperture_; }

    /// Sums over the frequencies of the band; P is the pattern's spectrum, F the field's.
    struct Sums {
        std::complex<double> product = 0;  ///< Σ P F*
        double energy = 0;                 ///< Σ|P|²
        void operator+=(const Sums& other) {
            product += other.product;
            energy += other.energy;
        }
    };
    /// Returns whether the band has any frequency of column x.
    bool has_column(std::size_t x) const { return active_columns_[x] != 0; }
    /// Adds frequency (x, y) of the spectrum, P = value.
    void add(std::size_t y, std::size_t x, std::complex<float> value, Sums& sums) const {
        if (active_[y * target_.extent(1) + x] == 0) return;
        sums.product += std::complex<double>(optics::times(value, std::conj(target_(y, x))));
        sums.energy += std::norm(value);
    }

    /// Match of a pattern and the field within the band.
    struct Match {
        /// ε = 1 − |Σ P F*|² / (Σ|P|² Σ|F|²), P summed over the band, F over all frequencies
        double error = 1;
        std::complex<double> scale = 0;  ///< s that minimises Σ|s P − F|², to ε Σ|F|²
        std::complex<float> slope = 0;   ///< 2 s* / Σ|F|²
    };
    /// Returns the match for sums over all frequencies.
    Match match(const Sums& sums) const;
    /// Matches a pattern. Replaces it by its spectrum.
    Match match(Array<std::complex<float>, 2>& pattern) const;
    /// Returns one frequency of the spectrum of ∂ε/∂pattern: 2 s* (s P − F) / Σ|F|² in the band, 0 outside.
    std::complex<float> derivative(const Match& match, std::size_t y, std::size_t x, std::complex<float> value) const {
        if (active_[y * target_.extent(1) + x] == 0) return 0;
        return optics::times(match.slope, optics::times(std::complex<float>(match.scale), value) - target_(y, x));
    }

  private:
    math::Fft2 fft_;
    Array<std::complex<float>, 2> target_;  // the field's spectrum, 0 outside the band
    std::vector<std::uint8_t> active_;      // [y][x]: 1 in the band
    std::vector<std::uint8_t> active_columns_;
    double energy_ = 0;  // Σ|F|² over all frequencies
    Aperture aperture_;
};

/// Throws Error(usage) for an invalid modulator, for a field of another pitch, and for an invalid clip.
void require_fitting(const FieldGrid& grid, const PatternOptions& options);

/// One look of a field on the pixels of a modulator, scaled to |F| ≤ 1.
struct FittedField {
    /// Throws Error(usage) if the field is dark on the modulator.
    FittedField(const FieldSource& source, std::size_t look, const PatternOptions& options);

    Array<std::complex<float>, 2> samples;
    double unit = 0;  ///< the source's modulus that became 1
    FieldBand band;
};

/// Sets the levels of a pattern to its values, rounded to those of the modulator.
void round_to_levels(Pattern& pattern, const PatternOptions& options);

/// Returns a pattern with these values, its levels and its measures.
Pattern complete_pattern(Array<float, 2> values, const FittedField& field, const CarriedOrder& order,
                         const PatternOptions& options);

/// Computes the patterns of one field, see encode_supervised().
SupervisedPatterns supervise(const FieldSource& field, const LightFieldSource& light_field, std::size_t channel,
                             const PatternOptions& options, const Progress& progress);

/// Tries the encodings phase, double_phase and gradient in this order. Returns the patterns of the first encoding that
/// gives every pattern at least sufficient_correlation. If there is none, returns the patterns of the encoding with the
/// highest minimum correlation over its patterns.
template <class Encode>
SuitablePatterns find_suitable(PatternOptions options, const Progress& progress, const Encode& encode) {
    SuitablePatterns best;
    double highest = -1;
    std::size_t attempts = 0;
    for (const Encoding encoding : {Encoding::phase, Encoding::double_phase, Encoding::gradient}) {
        options.encoding = encoding;
        std::vector<Pattern> patterns = encode(options, progress.part(attempts++, 3));
        const double correlation = std::ranges::min(patterns, {}, &Pattern::correlation).correlation;
        if (correlation <= highest) continue;
        highest = correlation;
        best = {encoding, std::move(patterns)};
        if (highest >= sufficient_correlation) break;
    }
    return best;
}

/// Throws Error(usage) unless squares of `side` pixels fit the modulator.
void require_squares_fit(View<const std::complex<float>, 2> field, std::size_t side);

}  // namespace hogel::patterns
