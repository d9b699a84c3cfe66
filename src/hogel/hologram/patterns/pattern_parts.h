// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/math/fft.h"
#include "hogel/pattern.h"

namespace hogel::hologram::patterns {

/// The carrier wave e^{2πi f_x·column}, by column. The useful order of a pattern is F times the carrier.
using Carrier = std::vector<std::complex<float>>;

/// The half bandwidth of a field along x, cycles per sample, which contains 95 % of its light; the edges of hogels
/// scatter the rest widely.
double band_along_x(View<const std::complex<float>, 2> field);

/// Encodes a field with |F| <= 1 as amplitudes in [0, 1], for the encodings for amplitude. Sets `carrier` and `angle`
/// to those of the order that carries F. Throws Error(usage) if the orders would overlap.
Array<float, 2> encode_amplitude(View<const std::complex<float>, 2> field, const PatternOptions& options,
                                 double wavelength, Carrier& carrier, double& angle);

/// Encoding::gerchberg_saxton: phases in cycles [0, 1), by alternating projections in squares.
Array<float, 2> iterate_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               const Progress& progress);

/// How often the phases of a pattern were changed, and what was reached.
struct Convergence {
    std::size_t iterations = 0;
    double correlation = 0;  ///< within the field's band, before rounding to levels
};

/// Encoding::gradient: phases in cycles [0, 1), by descent. Ends when the correlation with the field no longer gains.
Array<float, 2> descend_phases(View<const std::complex<float>, 2> field, const PatternOptions& options,
                               Convergence& convergence, const Progress& progress);
/// Iterations where PatternOptions::iterations is 0: alternating projections, and the most of a descent.
inline constexpr std::size_t projections = 40, max_descent_steps = 200;

/// The band of a field: the frequencies at which it has light, judged by its mean spectrum in squares. An aperture of
/// that shape would pass them alone.
class FieldBand {
  public:
    /// @param side  of the squares, samples
    FieldBand(View<const std::complex<float>, 2> field, std::size_t side);

    /// How a pattern and the field match within the band.
    struct Match {
        double error = 1;                ///< ε = 1 − |Σ P F*|² / (Σ|P|² Σ|F|²) over the band's frequencies
        std::complex<double> scale = 0;  ///< s, for which Σ|s P − F|² is least: ε Σ|F|²
    };
    /// Matches a pattern, which becomes its spectrum.
    Match match(Array<std::complex<float>, 2>& shown) const;
    /// From that spectrum to the pattern's derivative of the error: the samples of 2 s* (s P − F) / Σ|F|² in the band.
    void difference(const Match& match, Array<std::complex<float>, 2>& shown) const;

  private:
    math::Fft2 fft_;
    Array<std::complex<float>, 2> wanted_;  // the field's spectrum, 0 beyond the band
    std::vector<std::uint8_t> lit_;         // whether a frequency belongs to the band
    double energy_ = 0;                     // Σ|F|²
};

/// Throws Error(usage) unless squares of this side fit the modulator.
void require_squares_fit(View<const std::complex<float>, 2> field, std::size_t side);

}  // namespace hogel::hologram::patterns
