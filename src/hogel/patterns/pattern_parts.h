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

/// The sum of of_line(i) of all lines, in their order; the same for any number of threads.
template <class OfLine>
auto sum_of_lines(std::size_t count, const OfLine& of_line) {
    std::vector<decltype(of_line(count))> lines(count);
    work::parallel_for(count, [&](std::size_t i) { lines[i] = of_line(i); });
    decltype(of_line(count)) sum{};
    for (const auto& line : lines) sum += line;
    return sum;
}

/// The carrier wave e^{2πi f_x·column}, by column. The useful order of a pattern is F times the carrier.
using Carrier = std::vector<std::complex<float>>;

/// The half bandwidth of a field along x, cycles per sample, which contains 95 % of its light; the edges of hogels
/// scatter the rest widely.
double band_along_x(View<const std::complex<float>, 2> field);

/// The order of a pattern of amplitudes that carries F.
struct CarriedOrder {
    Carrier carrier;
    double frequency = 0;  ///< of the reference wave, cycles per sample; the order is at -frequency along x
    double angle = 0;      ///< of the reference wave, radians
    double room = 0;       ///< from the middle of the order to the light of others, cycles per sample
};

/// Encodes a field with |F| <= 1 as amplitudes in [0, 1], for the encodings for amplitude. Sets `order`. Throws
/// Error(usage) if the orders would overlap.
Array<float, 2> encode_amplitude(View<const std::complex<float>, 2> field, const PatternOptions& options,
                                 double wavelength, CarriedOrder& order);

/// The aperture for an order that carries a field: that for the field, around the order, and no wider than its room,
/// less a tenth.
Aperture aperture_around(const CarriedOrder& order, Aperture of_field);

/// Encoding::gerchberg_saxton: phases in cycles [0, 1), by alternating projections in squares.
Array<float, 2> iterate_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// How often the phases of a pattern were changed, and what was reached.
struct Convergence {
    std::size_t iterations = 0;
    double correlation = 0;  ///< behind the aperture, before rounding to levels
};

class FieldBand;

/// Encoding::gradient: phases in cycles [0, 1), by descent. Ends when the correlation with the field no longer gains.
/// @param band  of the field
Array<float, 2> descend_phases(View<const std::complex<float>, 2> field, const FieldBand& band,
                               const PatternOptions& options, Convergence& convergence, const Progress& progress);
/// Iterations where PatternOptions::iterations is 0: alternating projections, and the most of a descent.
inline constexpr std::size_t projections = 40, max_descent_steps = 200;

/// The band of a field: the frequencies that the aperture for it lets through, and a tenth farther. See
/// Pattern::aperture.
class FieldBand {
  public:
    explicit FieldBand(View<const std::complex<float>, 2> field);

    const Aperture& aperture() const { return aperture_; }

    /// Sums over frequencies of the band, of a pattern's spectrum P and the field's F.
    struct Sums {
        std::complex<double> product = 0;  ///< Σ P F*
        double energy = 0;                 ///< Σ|P|²
        void operator+=(const Sums& other) {
            product += other.product;
            energy += other.energy;
        }
    };
    /// Adds frequency x of row y of the spectrum.
    void add(std::size_t y, std::size_t x, std::complex<float> shown, Sums& sums) const {
        if (active_[y * wanted_.extent(1) + x] == 0) return;
        sums.product += std::complex<double>(optics::times(shown, std::conj(wanted_(y, x))));
        sums.energy += std::norm(shown);
    }

    /// How a pattern and the field match within the band.
    struct Match {
        /// ε = 1 − |Σ P F*|² / (Σ|P|² Σ|F|²), of P over the band's frequencies, of F over all
        double error = 1;
        std::complex<double> scale = 0;  ///< s, for which Σ|s P − F|² is least: ε Σ|F|²
        std::complex<float> slope = 0;   ///< 2 s* / Σ|F|²
    };
    /// From the sums over all frequencies.
    Match match(const Sums& sums) const;
    /// Matches a pattern, which becomes its spectrum.
    Match match(Array<std::complex<float>, 2>& shown) const;
    /// A frequency of the spectrum of the error's derivative by the pattern: 2 s* (s P − F) / Σ|F|² in the band.
    std::complex<float> derivative(const Match& match, std::size_t y, std::size_t x, std::complex<float> shown) const {
        if (active_[y * wanted_.extent(1) + x] == 0) return 0;
        return optics::times(match.slope, optics::times(std::complex<float>(match.scale), shown) - wanted_(y, x));
    }

  private:
    math::Fft2 fft_;
    Array<std::complex<float>, 2> wanted_;  // the field's spectrum, 0 beyond the band
    std::vector<std::uint8_t> active_;      // whether a frequency belongs to the band
    double energy_ = 0;                     // Σ|F|², also beyond the band
    Aperture aperture_;
};

/// The first of `phase`, `double_phase` and `gradient` by which all patterns have sufficient_correlation, or else the
/// one whose least correlation is highest, with the patterns.
/// @param encode  patterns encode(options, progress), for the encoding that the options name
template <class Encode>
SuitablePatterns find_suitable(PatternOptions options, const Progress& progress, const Encode& encode) {
    SuitablePatterns best;
    double highest = -1;
    std::size_t tried = 0;
    for (const Encoding encoding : {Encoding::phase, Encoding::double_phase, Encoding::gradient}) {
        options.encoding = encoding;
        std::vector<Pattern> patterns = encode(options, progress.part(tried++, 3));
        const double correlation = std::ranges::min(patterns, {}, &Pattern::correlation).correlation;
        if (correlation <= highest) continue;
        highest = correlation;
        best = {encoding, std::move(patterns)};
        if (highest >= sufficient_correlation) break;
    }
    return best;
}

/// Throws Error(usage) unless squares of this side fit the modulator.
void require_squares_fit(View<const std::complex<float>, 2> field, std::size_t side);

}  // namespace hogel::patterns
