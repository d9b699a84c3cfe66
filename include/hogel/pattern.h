// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/light_field.h"
#include "hogel/phase_code.h"
#include "hogel/progress.h"
#include "hogel/table.h"

namespace hogel {

/// A spatial light modulator. The members after `levels` are those of its profile (docs/modulators.md).
struct Modulator {
    std::string name;
    std::size_t width = 0, height = 0;      ///< pixels, at most max_modulator_side
    double pitch = 0;                       ///< distance of pixels, metres
    unsigned levels = 256;                  ///< number of evenly spaced drive levels, at most max_modulator_levels
    std::string title = {};                 ///< maker and model
    std::vector<std::string> aliases = {};  ///< other names, for find_modulator()
    std::string modulation = {};            ///< "phase" or "amplitude"; empty: either
    std::string phase_code = {};            ///< for parse_phase_code(); empty: any
    double fill_factor = 0;                 ///< share of a pixel's area that modulates; 0: unknown
    double shortest_wavelength = 0, longest_wavelength = 0;  ///< of its light, metres; 0: unknown
    double refresh_rate = 0;                                 ///< pictures a second; 0: unknown
    std::string flip = {};                                   ///< none, horizontal, vertical or both; empty: none
    std::string lut = {}, correction = {};                   ///< files of its level table and wavefront correction
    std::string source = {};                                 ///< address of a page with these figures
    bool verified = true;                                    ///< whether they were compared with `source`
    std::string note = {};                                   ///< one line for its user
    std::string fault = {};                                  ///< why the user's profile cannot be used, or empty

    friend bool operator==(const Modulator&, const Modulator&) = default;
};
inline constexpr unsigned max_modulator_side = 65536, max_modulator_levels = 65536;

/// Returns the modulators by name: those of hogel's profiles, those of *.json in the user's folder, which replace
/// profiles of the same name, and those that the program adds. The folder is $XDG_CONFIG_HOME/hogel/devices, or
/// ~/.config/hogel/devices, and is read once. Builds with HOGEL_MINIMAL have no profiles.
HOGEL_API Table<Modulator>& modulators();

/// Returns the names and aliases of modulators().
HOGEL_API std::vector<std::string> modulator_names();

/// Returns the row of modulators() with this name or alias, in upper or lower case. Throws Error(usage) for an unknown
/// name, with the nearest one and all, and for a device of another kind; Error(bad_input) for a profile of the user
/// with a fault.
HOGEL_API Modulator find_modulator(const std::string& name);

/// Returns what the user of a modulator should know: that its profile is not verified, the profile's note, and
/// wavelengths (metres) for which it is not made.
HOGEL_API std::vector<std::string> notes_about(const Modulator& modulator, std::span<const double> wavelengths);

/// Methods to represent a complex field F by the pixels of a modulator: phases 0..2π or transmitted amplitudes 0..1.
enum class Encoding {
    phase,             ///< phase of F; ignores |F| (kinoform)
    double_phase,      ///< phases φ ± acos|F| on a checkerboard, which represent the modulus (Hsueh and Sawchuk 1978)
    gerchberg_saxton,  ///< phase by alternating projections between the modulator and the local spectra of F
    gradient,    ///< phase by gradient descent towards F within its frequency band; light outside the band is free
    supervised,  ///< phase by descent of the error of photographs of a light field: encode_supervised()
    intensity,   ///< amplitude |F + R|², with a plane reference wave R
    bipolar,     ///< amplitude 2 Re(F R*), plus a constant that makes it positive
    burckhardt,  ///< amplitude of three real components, 120° apart, in successive columns (Burckhardt 1970)
    lee,         ///< amplitude of four real components, 90° apart, in successive columns (Lee 1970)
    binary,      ///< amplitude 1 where Re(F R*) > 0, 0 elsewhere
};

/// Returns whether an encoding is for phase modulators; the other encodings are for amplitude modulators.
HOGEL_API bool is_phase_only(Encoding encoding);

/// A row of encodings().
struct EncodingInfo {
    std::string name;
    std::string text;  ///< one line
    Encoding encoding;
    bool phase_only = false;  ///< for phase modulators; otherwise for amplitude modulators
};

/// Returns all encodings by name: phase, double-phase, gerchberg-saxton, gradient, supervised, intensity, bipolar,
/// burckhardt, lee, binary.
HOGEL_API Table<EncodingInfo>& encodings();

/// Options of encode_pattern().
struct PatternOptions {
    Encoding encoding = Encoding::phase;
    Modulator modulator;
    /// Angle of the reference wave R in the xz plane, radians, positive, for encodings with R. 0: the middle, in sines,
    /// of the range of angles that separate the diffraction orders.
    double reference_angle = 0;
    double clip = 0.001;  ///< fraction of the samples with a modulus that is clipped
    /// Side of the squares of the local spectra, pixels; the side of a hogel suits best.
    std::size_t window = 32;
    /// Iterations of gerchberg_saxton (0: 40) and supervised (0: 300), or their largest number for gradient (0: 200),
    /// which stops by itself.
    std::size_t iterations = 0;
    PhaseCode phase_code = {};  ///< mapping between levels and phases
};

/// A round aperture in the Fourier plane of a lens behind the modulator, in cycles per pixel. Light diffracted to ν
/// cycles per pixel arrives λfν/p from the axis, with p the pixel pitch and f the focal length.
struct Aperture {
    double x = 0, y = 0;  ///< centre, to the right and downwards
    double radius = 0;
};

/// Describes an aperture in words: in cycles per pixel, and in millimetres behind a lens of 200 mm focal length.
/// @param per_cycle  wavelength divided by the pixel pitch
HOGEL_API std::string describe(const Aperture& aperture, double per_cycle);
/// Returns the aperture of a text of describe(); nothing for other texts.
HOGEL_API std::optional<Aperture> parse_aperture(const std::string& text);

/// The pixel values of a modulator for one wavelength.
struct Pattern {
    Array<float, 2> values;  ///< [y][x] before rounding to levels: phases in cycles, [0, 1), or amplitudes, [0, 1]
    /// [y][x]: 0 to max_level, rounded to the modulator's levels; phases in PatternOptions::phase_code.
    Array<std::uint16_t, 2> levels;
    /// 255 for modulators of up to 256 levels, which are spread over 0 to 255; otherwise the number of levels less 1.
    std::uint16_t max_level = 255;
    double efficiency = 0;  ///< fraction of the modulator's light in the wave F, after rounding to levels
    /// For phase modulators, the fraction of the light on the modulator that reproduces the moduli of the field's local
    /// spectra, in squares of `window` pixels. It suits light fields, with arbitrary phases between directions.
    double light_field_efficiency = 0;
    /// Angle of the reference wave, radians; 0 without one. The order with the hologram leaves at the opposite angle.
    double reference_angle = 0;
    std::size_t iterations = 0;  ///< of an iterative encoding
    /// The aperture that suits the field. It passes 99.9 % of the field's light, or less if that needs a radius above
    /// 0.4. It is off frequency zero only if that makes it smaller by a fifth. For amplitude modulators it surrounds
    /// the useful order, and is narrowed to exclude light of other orders if it is a tenth too wide.
    Aperture aperture;
    /// For phase modulators, |Σ P F*| / √(Σ|P|² Σ|F|²) after rounding to levels. P is the pattern's spectrum within the
    /// aperture enlarged by a tenth of its radius, up to 0.4; F is the field's spectrum at all frequencies. The value
    /// is 1 if the aperture passes exactly the field.
    double correlation = 0;
    /// Power of the light on a pixel for which the useful order equals F, in units of |F|². The ratio of this value
    /// between wavelengths is the ratio of laser powers that shows the field's colours.
    double power = 0;
};

/// Returns the phase encoding that suits a field: the first of `phase`, `double_phase` and `gradient` with a
/// Pattern::correlation of at least sufficient_correlation, else the one with the highest. Throws as encode_pattern().
HOGEL_API Encoding suitable_encoding(const FieldSource& field, const PatternOptions& options);
inline constexpr double sufficient_correlation = 0.998;

/// Encodes look 0 of a field for a modulator. A larger field is cropped to its middle; a smaller field gets a dark
/// border. Memory: arrays of the modulator's size. Throws Error(usage) if the pitches differ, or if a reference wave
/// cannot separate the orders; the message names an angle or a pitch that suffices.
HOGEL_API Pattern encode_pattern(const FieldSource& field, const PatternOptions& options,
                                 const Progress& progress = {});

/// Encodes several fields, such as those of three wavelengths, as encode_pattern() does. Ranks (communicator.h) encode
/// one field each at a time; all return all patterns.
HOGEL_API std::vector<Pattern> encode_patterns(std::span<const std::shared_ptr<const FieldSource>> fields,
                                               const PatternOptions& options, const Progress& progress = {});

/// Quality of the photographs of patterns through random pupils, by waves, against those of their light field by rays.
/// Each pupil has a diameter of 1/6 to 3/8 of the light field's directions, and a random place and focus. Patterns are
/// shown in turn, so their intensities add up. One brightness factor serves all pupils.
struct PupilQuality {
    double psnr = 0;  ///< mean over pupils, decibels: of amplitudes, with the largest one of each photograph as peak
    double lowest_psnr = 0;   ///< of all pupils
    double psnr_middle = 0;   ///< mean over the pupils nearer to the middle than a third of the directions' half width
    double psnr_outside = 0;  ///< mean over the others
    double ssim = 0;          ///< mean structural similarity of amplitudes, in windows of 8x8 samples
    double contrast = 0;      ///< speckle contrast, σ/mean of intensities where the photograph by rays is flattest
    double efficiency = 0;    ///< share of the modulator's light in the light field's directions
    double power = 0;         ///< as Pattern::power: shows the radiance of the light field
};

/// Phase patterns of a light field for one wavelength, shown in turn.
struct SupervisedPatterns {
    std::vector<Pattern> frames;
    PupilQuality quality;
};

/// Computes the phase patterns of a light field whose photographs through pupils are nearest to those by rays: descent
/// of the error of random pupils, on the phases that the modulator can show. Pattern::efficiency and Pattern::power are
/// those of the quality, the aperture surrounds the light field's directions, and the measures that compare a pattern
/// with a field are 0. Memory: arrays of the modulator's size for each look, and one channel of the light field. Ranks
/// (communicator.h) encode one field each at a time; all return all patterns. Throws Error(usage) as encode_pattern()
/// does, for directions that the modulator does not show, and for fewer than 3x3 directions.
/// @param fields       holograms of the light field, where the descent starts, one per wavelength; one pattern is made
///                     of each look, so looks should have independent phases
/// @param light_field  its depth gives the range of focus
/// @param channels     channel of the light field of each field
HOGEL_API std::vector<SupervisedPatterns> encode_supervised(std::span<const std::shared_ptr<const FieldSource>> fields,
                                                            const LightFieldSource& light_field,
                                                            std::span<const std::size_t> channels,
                                                            const PatternOptions& options,
                                                            const Progress& progress = {});

/// Measures phase patterns, shown in turn, through 50 random pupils, none of which encode_supervised() uses.
HOGEL_API PupilQuality pupil_quality(std::span<const Pattern> patterns, const LightFieldSource& light_field,
                                     std::size_t channel, double wavelength, const PatternOptions& options,
                                     const Progress& progress = {});

/// The patterns of several fields by the encoding that suits all of them.
struct SuitablePatterns {
    Encoding encoding = Encoding::phase;
    std::vector<Pattern> patterns;           ///< one per field; of patterns shown in turn, [frame][field]
    std::vector<PupilQuality> quality = {};  ///< for `supervised`, one per field
};

/// Encodes several fields by the encoding that suits all, as suitable_encoding() selects it; computes patterns once.
HOGEL_API SuitablePatterns encode_suitably(std::span<const std::shared_ptr<const FieldSource>> fields,
                                           const PatternOptions& options, const Progress& progress = {});

/// What a panel adds to a pattern.
struct PanelOptions {
    PanelLevels levels = {};
    Array<float, 2> correction = {};  ///< [y][x] as sent: levels added to those of phases, modulo all; empty: none
    double lens = 0;                  ///< focal length of a lens in the plane of the pattern, metres; 0: none
    double blaze_x = 0, blaze_y = 0;  ///< frequency of a blazed grating, cycles a pixel to the right and upwards
};

/// Throws Error(usage) if a level table or a correction does not have the size of the modulator, or if phases would be
/// added to amplitudes.
HOGEL_API void require_panel(const PanelOptions& panel, const PatternOptions& options);

/// Returns what is sent to a panel, [y][x]: lens and grating are added to the phases, then the pattern is flipped, the
/// correction added, and the sum rounded to levels, which the table replaces. The pattern is not changed. Throws as
/// require_panel() does.
HOGEL_API Array<std::uint16_t, 2> panel_levels(const Pattern& pattern, const PatternOptions& options,
                                               const PanelOptions& panel, double wavelength);

/// Reads a level table: a line for each level, from 0, with the level to send, or with the index and the level,
/// separated by a comma, a semicolon or blanks. Text after # is a comment. Throws Error(bad_input), with the line.
HOGEL_API std::vector<std::uint16_t> read_level_table(const std::filesystem::path& path);

/// Returns the levels of patterns of one modulator, [y][x][pattern], for write_levels(). Throws Error(usage) if they
/// differ in size.
HOGEL_API Array<std::uint16_t, 3> joined_levels(std::span<const Pattern> patterns);

/// Returns the complex transmission of a pattern, [y][x]: e^{2πi v} for phases or v for amplitudes, with v the values
/// rounded to levels. It is the field behind the modulator in a uniform laser beam.
HOGEL_API Array<std::complex<float>, 2> transmission(const Pattern& pattern, Encoding encoding,
                                                     const PhaseCode& phase_code = {});

}  // namespace hogel
