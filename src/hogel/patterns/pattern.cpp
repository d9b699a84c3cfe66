// SPDX-License-Identifier: Apache-2.0
#include "hogel/pattern.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <regex>

#include "hogel/core/stop_scope.h"
#include "hogel/math/fft.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/patterns/phasors.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel {

using namespace patterns;

namespace {

using Complex = std::complex<float>;

// Calls element(i) for all elements of an array, row by row on all threads.
template <class Element>
void for_rows(const Shape<2>& shape, const Element& element) {
    work::parallel_for(shape[0], [&](std::size_t y) {
        for (std::size_t i = y * shape[1]; i < (y + 1) * shape[1]; ++i) element(i);
    });
}

// Returns the middle of one look of the field, or the field with a dark border, in the size of the modulator.
Array<Complex, 2> fit(const FieldSource& source, std::size_t look, const Modulator& modulator) {
    const Grid& plane = source.grid().plane;
    Array<Complex, 2> field({modulator.height, modulator.width});
    const std::size_t width = std::min(plane.width, modulator.width), height = std::min(plane.height, modulator.height);
    const std::size_t left = (modulator.width - width) / 2, top = (modulator.height - height) / 2;
    // Reads bands of rows on all threads, in the source's alignment.
    const std::size_t y0 = (plane.height - height) / 2, rows = std::max<std::size_t>(64, source.alignment());
    const std::size_t first = y0 / rows, bands = (y0 + height + rows - 1) / rows - first;
    work::parallel_for(bands, [&](std::size_t band) {
        const std::size_t from = std::max(y0, (first + band) * rows),
                          to = std::min(y0 + height, (first + band + 1) * rows);
        const Region region{(plane.width - width) / 2, from, width, to - from};
        Array<Complex, 2> part({region.height, region.width});
        source.read(region, look, part);
        for (std::size_t y = 0; y < region.height; ++y)
            std::copy_n(&part(y, 0), width, &field(top + from - y0 + y, left));
    });
    return field;
}

// Scales the field to |F| ≤ 1, clipping the share `clip` of its samples. Returns the modulus that became 1.
float normalise(Array<Complex, 2>& field, double clip) {
    std::vector<float, CacheLineAllocator<float>> moduli(field.size());
    for_rows(field.shape(), [&](std::size_t i) { moduli[i] = std::abs(field.data()[i]); });
    std::erase(moduli, 0.0f);
    if (moduli.empty()) throw Error(ErrorCode::usage, "the hologram is dark on the area of the modulator");
    const auto clipped = static_cast<std::size_t>(clip * static_cast<double>(moduli.size()));
    const auto largest = moduli.end() - 1 - static_cast<std::ptrdiff_t>(clipped);
    std::nth_element(moduli.begin(), largest, moduli.end());
    const float scale = 1 / *largest;
    for_rows(field.shape(), [&](std::size_t i) {
        Complex& value = field.data()[i];
        value *= scale;
        if (const float modulus = std::abs(value); modulus > 1) value /= modulus;
    });
    return 1 / scale;
}

Array<float, 2> encode_phase(View<const Complex, 2> field, const FieldBand& band, const PatternOptions& options,
                             Convergence& convergence, const Progress& progress) {
    if (options.encoding == Encoding::gerchberg_saxton) {
        convergence.iterations = options.iterations > 0 ? options.iterations : projections;
        return iterate_phases(field, options, progress);
    }
    if (options.encoding == Encoding::gradient) return descend_phases(field, band, options, convergence, progress);
    Array<float, 2> cycles(field.shape());
    work::parallel_for(field.extent(0), [&](std::size_t y) {
        const std::span<float> row(&cycles(y, 0), field.extent(1));
        if (options.encoding == Encoding::double_phase)
            double_phases(&field(y, 0), y % 2 == 0 ? 1.0f : -1.0f, row);
        else
            phases_of(&field(y, 0), row);
    });
    return cycles;
}

unsigned rounded(double value) { return static_cast<unsigned>(std::lround(value)); }

// Share of the modulator's light in F times the carrier: |<E, F c>|² / (<F, F> pixels).
double efficiency_of(View<const Complex, 2> transmitted, View<const Complex, 2> field, const Carrier& carrier) {
    const FieldBand::Sums sums = sum_of_lines(field.extent(0), [&](std::size_t y) {
        FieldBand::Sums row;
        for (std::size_t x = 0; x < field.extent(1); ++x) {
            const Complex wave = carrier.empty() ? field(y, x) : optics::times(field(y, x), carrier[x]);
            row.product += std::complex<double>(optics::times(transmitted(y, x), std::conj(wave)));
            row.energy += std::norm(wave);
        }
        return row;
    });
    return std::norm(sums.product) / (sums.energy * static_cast<double>(field.size()));
}

double mean_power(View<const Complex, 2> field) {
    return sum_of_lines(field.extent(0),
                        [&](std::size_t y) {
                            double row = 0;
                            for (std::size_t x = 0; x < field.extent(1); ++x) row += std::norm(field(y, x));
                            return row;
                        }) /
           static_cast<double>(field.size());
}

struct LightShare {
    double light = 0, all = 0;
    void operator+=(const LightShare& other) {
        light += other.light;
        all += other.all;
    }
};

// Share of the modulator's light that reproduces the moduli of the field's local spectra B: (Σ|A||B|)²/Σ|B|², over the
// energy Σ|A|², summed over squares.
double light_field_efficiency_of(View<const Complex, 2> transmitted, View<const Complex, 2> field, std::size_t side) {
    side = std::min({side, field.extent(0), field.extent(1)});
    const math::Fft2 fft(side, side);
    const LightShare share = sum_of_lines(field.extent(0) / side, [&](std::size_t row) {
        Array<Complex, 2> pattern_spectrum({side, side}), field_spectrum({side, side});
        LightShare row_share;
        const std::size_t y0 = row * side;
        for (std::size_t x0 = 0; x0 + side <= field.extent(1); x0 += side) {
            for (std::size_t y = 0; y < side; ++y) {
                std::copy_n(&transmitted(y0 + y, x0), side, &pattern_spectrum(y, 0));
                std::copy_n(&field(y0 + y, x0), side, &field_spectrum(y, 0));
            }
            fft.forward(pattern_spectrum);
            fft.forward(field_spectrum);
            double product = 0, energy = 0;
            for (std::size_t f = 0; f < pattern_spectrum.size(); ++f) {
                product += std::abs(pattern_spectrum.data()[f]) * std::abs(field_spectrum.data()[f]);
                energy += std::norm(field_spectrum.data()[f]);
                row_share.all += std::norm(pattern_spectrum.data()[f]);
            }
            if (energy > 0) row_share.light += product * product / energy;
        }
        return row_share;
    });
    return share.all > 0 ? share.light / share.all : 0;
}

// Describes a hologram with the modulator's pixels as samples: its hogels have 2, 4 or 8 of them on a side.
std::string hologram_for(const Modulator& modulator) {
    std::vector<std::string> hogels;
    for (const std::size_t side : {2, 4, 8})
        if (modulator.width % side == 0 && modulator.height % side == 0)
            hogels.push_back(fmt::format("{}x{}", modulator.width / side, modulator.height / side));
    if (hogels.empty()) hogels.push_back(fmt::format("{}x{}", modulator.width, modulator.height));
    return fmt::format("make the hologram {} wide, with {} hogels and a pitch of {}",
                       format_length(static_cast<double>(modulator.width) * modulator.pitch), fmt::join(hogels, " or "),
                       format_length(modulator.pitch));
}

}  // namespace

std::uint16_t patterns::Rounding::operator()(float value) const {
    const bool is_spread = levels < 256;
    unsigned level = 0;
    if (phases) {  // phases wrap around from the last level to the first
        double turns = value;
        if (is_spread) {
            const unsigned byte = rounded(value * static_cast<float>(levels)) % levels * 256 / levels;
            turns = byte / 256.0;
        }
        level = code.level(2 * std::numbers::pi * turns, largest());
    } else {
        level = rounded(value * static_cast<float>(levels - 1));
        if (is_spread) level = rounded(level * 255.0 / (levels - 1));
    }
    return static_cast<std::uint16_t>(level);
}

bool is_phase_only(Encoding encoding) {
    return encoding == Encoding::phase || encoding == Encoding::double_phase ||
           encoding == Encoding::gerchberg_saxton || encoding == Encoding::gradient || encoding == Encoding::supervised;
}

Table<EncodingInfo>& encodings() {
    const auto row = [](const char* name, const char* text, Encoding encoding) {
        return EncodingInfo{name, text, encoding, is_phase_only(encoding)};
    };
    static Table<EncodingInfo> table(
        "encoding",
        {
            row("phase", "the field's phase; its modulus is discarded", Encoding::phase),
            row("double-phase", "the modulus as two phases on a checkerboard", Encoding::double_phase),
            row("gerchberg-saxton", "phases by alternating projections", Encoding::gerchberg_saxton),
            row("gradient", "phases by descent towards the field within its band", Encoding::gradient),
            row("supervised", "phases by descent towards photographs of a light field", Encoding::supervised),
            row("intensity", "amplitudes: the intensity of the interference with a reference wave",
                Encoding::intensity),
            row("bipolar", "amplitudes: the real part on a reference wave, plus a constant", Encoding::bipolar),
            row("burckhardt", "amplitudes of three real components in successive columns", Encoding::burckhardt),
            row("lee", "amplitudes of four real components in successive columns", Encoding::lee),
            row("binary", "amplitudes 0 and 1 by the sign of the real part on a reference wave", Encoding::binary),
        },
        "encoding");
    return table;
}

std::string describe(const Aperture& aperture, double per_cycle) {
    constexpr double focal_length = 0.2;
    std::string middle;
    if (aperture.x != 0 || aperture.y != 0)
        middle = fmt::format(" around {:.4f} to the right and {:.4f} up", aperture.x, 0.0 - aperture.y);
    return fmt::format("radius {:.4f} cycles a pixel{}, {:.2f} mm at a lens of 200 mm", aperture.radius, middle,
                       aperture.radius * per_cycle * focal_length / 1e-3);
}

std::optional<Aperture> parse_aperture(const std::string& text) {
    static const std::regex form(
        R"(radius (\S+) cycles a pixel(?: around (\S+) to the right and (\S+) up)?, \S+ mm at a lens of 200 mm)");
    std::smatch parts;
    if (!std::regex_match(text, parts, form)) return {};
    const auto number = [&](std::size_t i) {
        return parts[i].matched ? std::strtod(parts[i].str().c_str(), nullptr) : 0;
    };
    return Aperture{number(2), 0.0 - number(3), number(1)};
}

namespace patterns {

void require_fitting(const FieldGrid& grid, const PatternOptions& options) {
    const Modulator& modulator = options.modulator;
    if (modulator.width == 0 || modulator.height == 0 || !(modulator.pitch > 0) || modulator.levels < 2 ||
        modulator.levels > max_modulator_levels)
        throw Error(ErrorCode::usage, "pixel_pitch",
                    fmt::format("invalid modulator: {}x{} pixels, pitch {}, {} levels; expected a "
                                "positive size and pitch, and 2 to {} levels",
                                modulator.width, modulator.height, format_length(modulator.pitch), modulator.levels,
                                max_modulator_levels));
    if (modulator.modulation == "amplitude" && is_phase_only(options.encoding))
        throw Error(ErrorCode::usage, "encoding",
                    fmt::format("{} modulates amplitudes; expected intensity, bipolar, burckhardt, lee or binary",
                                modulator.name));
    for (double pitch : {grid.plane.pitch_x, grid.plane.pitch_y})
        if (std::abs(pitch - modulator.pitch) > 1e-3 * modulator.pitch)
            throw Error(ErrorCode::usage, "pixel_pitch",
                        fmt::format("the hologram's samples are {} apart, but the modulator's pixels {}; {}",
                                    format_length(pitch), format_length(modulator.pitch), hologram_for(modulator)));
    if (!(options.clip >= 0 && options.clip < 1))
        throw Error(ErrorCode::usage, "clip", "the share of clipped samples must be at least 0 and below 1");
}

void round_to_levels(Pattern& pattern, const PatternOptions& options) {
    const Rounding round{options.modulator.levels, is_phase_only(options.encoding), options.phase_code};
    pattern.max_level = round.largest();
    pattern.levels = Array<std::uint16_t, 2>(pattern.values.shape());
    for_rows(pattern.values.shape(),
             [&](std::size_t i) { pattern.levels.data()[i] = round(pattern.values.data()[i]); });
}

FittedField::FittedField(const FieldSource& source, std::size_t look, const PatternOptions& options)
    : samples(fit(source, look, options.modulator)), unit(normalise(samples, options.clip)), band(samples) {}

Pattern complete_pattern(Array<float, 2> values, const FittedField& field, const CarriedOrder& order,
                         const PatternOptions& options) {
    const bool phases = is_phase_only(options.encoding);
    Pattern pattern;
    pattern.values = std::move(values);
    round_to_levels(pattern, options);
    Array<Complex, 2> transmitted = transmission(pattern, options.encoding, options.phase_code);
    pattern.efficiency = efficiency_of(transmitted, field.samples, order.carrier);
    pattern.power = field.unit * field.unit * mean_power(field.samples) / pattern.efficiency;
    pattern.reference_angle = order.angle;
    pattern.aperture = phases ? field.band.aperture() : aperture_around(order, field.band.aperture());
    if (!phases) return pattern;
    pattern.light_field_efficiency = light_field_efficiency_of(transmitted, field.samples, options.window);
    pattern.correlation = std::sqrt(1 - field.band.match(transmitted).error);
    return pattern;
}

}  // namespace patterns

Pattern encode_pattern(const FieldSource& source, const PatternOptions& options, const Progress& progress) {
    const core::StopScope scope(progress);
    require_fitting(source.grid(), options);
    if (options.encoding == Encoding::supervised)
        throw Error(ErrorCode::usage, "encoding",
                    "supervised needs a light field or a scene; use gradient for a field");
    const FittedField field(source, 0, options);
    CarriedOrder order;
    Convergence convergence;
    Array<float, 2> values = is_phase_only(options.encoding)
                                 ? encode_phase(field.samples, field.band, options, convergence, progress)
                                 : encode_amplitude(field.samples, options, source.grid().wavelength, order);
    Pattern pattern = complete_pattern(std::move(values), field, order, options);
    pattern.iterations = convergence.iterations;
    return pattern;
}

Encoding suitable_encoding(const FieldSource& source, const PatternOptions& options) {
    return find_suitable(options, {},
                         [&](const PatternOptions& candidate, const Progress& progress) {
                             return std::vector{encode_pattern(source, candidate, progress)};
                         })
        .encoding;
}

Array<Complex, 2> transmission(const Pattern& pattern, Encoding encoding, const PhaseCode& phase_code) {
    Array<Complex, 2> result(pattern.levels.shape());
    const double largest = pattern.max_level;
    std::vector<Complex> by_level(std::size_t{pattern.max_level} + 1);
    for (std::size_t level = 0; level < by_level.size(); ++level)
        by_level[level] = is_phase_only(encoding)
                              ? Complex(std::polar(1.0, phase_code.phase(static_cast<double>(level), largest)))
                              : Complex(static_cast<float>(static_cast<double>(level) / largest));
    for_rows(result.shape(), [&](std::size_t i) { result.data()[i] = by_level[pattern.levels.data()[i]]; });
    return result;
}

}  // namespace hogel
