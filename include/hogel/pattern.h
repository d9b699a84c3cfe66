// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/table.h"

namespace hogel {

/// A spatial light modulator: what a pattern must fit.
struct Modulator {
    std::string name;
    std::size_t width = 0, height = 0;  ///< pixels
    double pitch = 0;                   ///< metres between pixels
    unsigned levels = 256;              ///< that a pixel can show, evenly spaced

    friend bool operator==(const Modulator&, const Modulator&) = default;
};

/// Common modulators by name, from their makers' data sheets, and those that a program adds.
HOGEL_API Table<Modulator>& modulators();

/// How a complex field becomes the values that a modulator shows: phases 0..2π, or transmitted amplitudes 0..1.
enum class Encoding {
    phase,             ///< phase: the field's own, its modulus forgotten (kinoform)
    double_phase,      ///< phase: the modulus as two phases φ ± acos|F| on a checkerboard (Hsueh and Sawchuk 1978)
    gerchberg_saxton,  ///< phase: alternating projections between the modulator and the field's local spectra
    gradient,    ///< phase: stochastic gradient descent towards the field's local spectra, wherever they are taken
    intensity,   ///< amplitude: |F + R|² with a plane reference wave R
    bipolar,     ///< amplitude: 2 Re(F R*), raised to be positive
    burckhardt,  ///< amplitude: three real components, 120° apart, in successive columns (Burckhardt 1970)
    lee,         ///< amplitude: four real components, 90° apart, in successive columns (Lee 1970)
    binary,      ///< amplitude: one where Re(F R*) > 0, zero elsewhere
};

HOGEL_API bool is_phase_only(Encoding encoding);

struct EncodingInfo {
    std::string name;
    std::string text;  ///< one line
    Encoding encoding;
    bool phase_only = false;  ///< for a modulator of phases; otherwise of amplitudes
};

/// All encodings by name: phase, double-phase, gerchberg-saxton, gradient, intensity, bipolar, burckhardt, lee, binary.
HOGEL_API Table<EncodingInfo>& encodings();

struct PatternOptions {
    Encoding encoding = Encoding::phase;
    Modulator modulator;
    /// Of R, radians in the plane of x and z, for the encodings with R; 0: the middle of the angles that keep the
    /// orders apart.
    double reference_angle = 0;
    double clip = 0.001;          ///< share of the samples whose modulus may be cut to the largest that is shown
    std::size_t window = 32;      ///< side in pixels of the squares whose spectra iterated phases keep: a hogel
    std::size_t iterations = 40;  ///< of Gerchberg–Saxton, or steps of the descent
    std::uint64_t seed = 1;       ///< of the descent, which draws where its squares lie
};

/// The values of a modulator's pixels for one wavelength.
struct Pattern {
    Array<float, 2> values;         ///< cycles of phase [0, 1), or amplitudes [0, 1], before rounding to levels; [y][x]
    Array<std::uint8_t, 2> levels;  ///< 0 .. 255, in steps of the modulator's levels: for phases 256 would be 2π
    double efficiency = 0;  ///< share of the light on the modulator that goes into the wave F, as rounded to levels
    /// Phases: the share of the light on the modulator that makes the moduli of the field's local spectra, in squares
    /// of the window's side. It is the measure for a light field, where the phases between directions are free.
    double light_field_efficiency = 0;
    double reference_angle = 0;  ///< of R, or of the order that successive columns diffract into; 0 without
};

/// Encodes look 0 of a field for a modulator: its middle part, or all with a dark border. The whole modulator is in
/// memory.
/// Throws Error(usage) where pitches differ, and where a reference wave cannot keep its orders apart, naming the angle
/// or the pitch that would do.
HOGEL_API Pattern encode_pattern(const FieldSource& field, const PatternOptions& options,
                                 const Progress& progress = {});

/// The complex transmission of a pattern, e^{2πi v} or v of its rounded levels: the field of a uniform laser beam
/// behind the modulator.
HOGEL_API Array<std::complex<float>, 2> transmission(const Pattern& pattern, Encoding encoding);

}  // namespace hogel
