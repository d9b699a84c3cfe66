// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/phase_code.h"
#include "hogel/progress.h"
#include "hogel/table.h"

namespace hogel {

/// A spatial light modulator.
struct Modulator {
    std::string name;
    std::size_t width = 0, height = 0;  ///< pixels
    double pitch = 0;                   ///< metres between pixels
    unsigned levels = 256;              ///< number of evenly spaced levels of a pixel

    friend bool operator==(const Modulator&, const Modulator&) = default;
};

/// Common modulators by name, from their makers' data sheets, and those that a program adds.
HOGEL_API Table<Modulator>& modulators();

/// The way to represent a complex field F by the pixels of a modulator: phases 0..2π or transmitted amplitudes 0..1.
enum class Encoding {
    phase,             ///< phase: that of the field; its modulus is ignored (kinoform)
    double_phase,      ///< phase: the modulus as two phases φ ± acos|F| on a checkerboard (Hsueh and Sawchuk 1978)
    gerchberg_saxton,  ///< phase: alternating projections between the modulator and the field's local spectra
    gradient,          ///< phase: descent towards the field within its band of frequencies; the light beyond is free
    intensity,         ///< amplitude: |F + R|² with a plane reference wave R
    bipolar,           ///< amplitude: 2 Re(F R*) plus a constant that makes it positive
    burckhardt,        ///< amplitude: three real components, 120° apart, in successive columns (Burckhardt 1970)
    lee,               ///< amplitude: four real components, 90° apart, in successive columns (Lee 1970)
    binary,            ///< amplitude: 1 where Re(F R*) > 0, 0 elsewhere
};

/// Whether an encoding is for modulators of phase; the others are for modulators of amplitude.
HOGEL_API bool is_phase_only(Encoding encoding);

/// A row of encodings().
struct EncodingInfo {
    std::string name;
    std::string text;  ///< one line
    Encoding encoding;
    bool phase_only = false;  ///< true: for modulators of phase; false: of amplitude
};

/// All encodings by name: phase, double-phase, gerchberg-saxton, gradient, intensity, bipolar, burckhardt, lee, binary.
HOGEL_API Table<EncodingInfo>& encodings();

/// Options of encode_pattern().
struct PatternOptions {
    Encoding encoding = Encoding::phase;
    Modulator modulator;
    /// Angle of the reference wave R, radians in the plane of x and z, for the encodings with R. 0: the middle of the
    /// range of angles that keep the diffraction orders apart.
    double reference_angle = 0;
    double clip = 0.001;      ///< share of the samples whose modulus is clipped to the largest that is shown
    std::size_t window = 32;  ///< side in pixels of the squares whose spectra are the local spectra; best the side of
                              ///< a hogel
    /// Iterations of Gerchberg–Saxton, or the limit of the descent, which ends when it no longer gains. 0: 40, and 200.
    std::size_t iterations = 0;
    PhaseCode phase_code = {};  ///< how levels stand for phases
};

/// A round aperture in the plane where a lens makes the spectrum of a modulator's light, cycles per pixel. What
/// diffracts to ν cycles per pixel arrives λfν/p beside the axis, with p the pixels' pitch and f the focal length.
struct Aperture {
    double x = 0, y = 0;  ///< its middle, to the right and downwards
    double radius = 0;
};

/// An aperture in words: in cycles, and in millimetres behind a lens of 200 mm.
/// @param per_cycle  wavelength over the pixels' pitch
HOGEL_API std::string describe(const Aperture& aperture, double per_cycle);

/// The values of a modulator's pixels for one wavelength.
struct Pattern {
    Array<float, 2> values;  ///< [y][x]: phases in cycles [0, 1), or amplitudes [0, 1], before rounding to levels
    Array<std::uint8_t, 2>
        levels;  ///< [y][x]: 0 to 255, rounded to the modulator's levels; for phases in PatternOptions::phase_code
    double efficiency = 0;  ///< share of the light on the modulator that goes into the wave F, after rounding to levels
    /// For phases, the share of the light on the modulator that reproduces the moduli of the field's local spectra, in
    /// squares of `window` pixels. This is the measure for light fields, where the phases between directions are
    /// arbitrary.
    double light_field_efficiency = 0;
    /// Angle of the reference wave, radians; 0 without one. The order that shows the hologram leaves at the opposite
    /// angle, also where successive columns make it.
    double reference_angle = 0;
    std::size_t iterations = 0;  ///< of an iterated encoding
    /// The aperture for the field: it lets 99.9 % of its light through, or less where that would take a radius above
    /// 0.4. Beside frequency zero only where that makes it smaller by a fifth. For amplitudes it is around the useful
    /// order, and no wider than keeps out the light of other orders if it is a tenth too wide.
    Aperture aperture;
    /// For phases, |Σ P F*| / √(Σ|P|² Σ|F|²), after rounding to levels: the pattern's spectrum P within the aperture
    /// and a tenth of its radius farther, up to 0.4, the field's spectrum F everywhere. 1 if the aperture lets the
    /// field through, and nothing else.
    double correlation = 0;
    /// Power of the light on a pixel for which the useful order is F, in units of |F|². Between the patterns of several
    /// wavelengths its ratio is that of the powers which show the field's colours.
    double power = 0;
};

/// The encoding for a modulator of phase that suits a field: the first of `phase`, `double_phase` and `gradient` whose
/// pattern correlates with the field by 0.998 or more, or else the one that correlates most. Throws Error(usage) as
/// encode_pattern() does.
HOGEL_API Encoding suitable_encoding(const FieldSource& field, const PatternOptions& options);
inline constexpr double sufficient_correlation = 0.998;

/// Encodes look 0 of a field for a modulator. A field larger than the modulator is cropped to its middle, a smaller one
/// gets a dark border. The whole modulator is in memory. Throws Error(usage) if the pitches differ, and if a reference
/// wave cannot keep the orders apart, naming the angle or the pitch that suffices.
HOGEL_API Pattern encode_pattern(const FieldSource& field, const PatternOptions& options,
                                 const Progress& progress = {});

/// encode_pattern() for each of several fields, such as those of three wavelengths. The processes of a team (team.h)
/// take a field each, and all of them get all patterns.
HOGEL_API std::vector<Pattern> encode_patterns(std::span<const std::shared_ptr<const FieldSource>> fields,
                                               const PatternOptions& options, const Progress& progress = {});

/// The patterns of several fields by the encoding that suits all of them.
struct SuitablePatterns {
    Encoding encoding = Encoding::phase;
    std::vector<Pattern> patterns;
};

/// encode_patterns() by the encoding that suits all fields, as suitable_encoding() judges it, without computing the
/// patterns again.
HOGEL_API SuitablePatterns encode_suitably(std::span<const std::shared_ptr<const FieldSource>> fields,
                                           const PatternOptions& options, const Progress& progress = {});

/// The complex transmission of a pattern [y][x], e^{2πi v} for phases or v for amplitudes, with v its values rounded to
/// levels. It is the field behind the modulator in a uniform laser beam.
HOGEL_API Array<std::complex<float>, 2> transmission(const Pattern& pattern, Encoding encoding,
                                                     const PhaseCode& phase_code = {});

}  // namespace hogel
