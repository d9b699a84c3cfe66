// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/patterns/pattern_parts.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;

constexpr double share_within_band = 0.95;

// Carrier frequency of components in successive columns: fixed at one cycle per group of columns. Orders lie at its
// multiples, so it must be at least twice the field's band.
double column_carrier(double band, std::size_t columns, double pitch) {
    const double carrier = 1.0 / static_cast<double>(columns);
    if (2 * band > carrier)
        throw Error(
            ErrorCode::usage, "encoding",
            fmt::format("at a pitch of {} the hologram has frequencies up to {:.3f} cycles a pixel, but groups "
                        "of {} columns allow {:.3f}; a pitch of {} would do",
                        format_length(pitch), band, columns, carrier / 2, format_length(pitch * carrier / (2 * band))));
    return carrier;
}

double degrees(double sine) { return std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi; }

// Frequency f of the reference wave, cycles per sample. The fringe FR* lies at −f and its conjugate at +f, as wide as F
// (half width `band`). |F|², part of an intensity, lies around zero, twice as wide. None may overlap or alias: [K] 3.2.
double reference_carrier(double band, const PatternOptions& options, double wavelength) {
    const double pitch = options.modulator.pitch, to_sine = wavelength / pitch;
    const double min_carrier = (options.encoding == Encoding::intensity ? 3 : 1) * band;
    const char* const parameter = options.reference_angle == 0 ? "encoding" : "reference";
    const double requested = std::sin(options.reference_angle) / to_sine;
    const double carrier =
        options.reference_angle == 0 ? std::max(min_carrier, 0.5 * (min_carrier + 0.5 - band)) : requested;
    if (carrier < min_carrier * (1 - 1e-9))
        throw Error(ErrorCode::usage, parameter,
                    fmt::format("a reference beam at {:.2f} degrees overlaps the object, whose light reaches {:.2f} "
                                "degrees; one at {:.2f} degrees would do",
                                degrees(requested * to_sine), degrees(band * to_sine), degrees(min_carrier * to_sine)));
    if (carrier + band > 0.5)
        throw Error(ErrorCode::usage, parameter,
                    fmt::format("the fringe of light to {:.2f} degrees with a reference beam at {:.2f} degrees is too "
                                "fine for a pitch of {}; {} would do",
                                degrees(band * to_sine), degrees(carrier * to_sine), format_length(pitch),
                                format_length(pitch * 0.5 / (carrier + band))));
    return carrier;
}

// Distance from the middle of the useful order at −frequency to the nearest other light, cycles per sample: halfway to
// the next order of columns; |F|² around zero for an intensity; otherwise the undiffracted light.
double clearance_around(double frequency, double band, Encoding encoding) {
    if (encoding == Encoding::burckhardt || encoding == Encoding::lee) return frequency / 2;
    return encoding == Encoding::intensity ? frequency - 2 * band : frequency;
}

// Non-negative real components of complex numbers, `columns` of them, in successive columns. Component m of a number of
// modulus |F| and phase φ is |F| sin(s − |φ − ms|), with sectors s = 2π/columns; only the two adjacent to its phase are
// nonzero. Components more than a right angle apart can exceed the modulus, so all are scaled down.
class Components {
  public:
    Components(std::size_t columns, std::size_t width) {
        const double sector = 2 * std::numbers::pi / static_cast<double>(columns);
        const double largest = columns < 4 ? 1 : std::sin(sector);
        sine_ = static_cast<float>(std::sin(sector) / largest);
        cosine_ = static_cast<float>(std::cos(sector) / largest);
        for (std::size_t x = 0; x < width; ++x)
            turns_.push_back(Complex(std::polar(1.0, -sector * static_cast<double>(x % columns))));
    }

    // Returns the component of column x. With G = F e^{−ims}, it is sin(s) Re G − cos(s) |Im G|, or 0 if that is less.
    float operator()(Complex value, std::size_t x) const {
        const Complex turned = optics::times(value, turns_[x]);
        return sine_ * turned.real() - cosine_ * std::abs(turned.imag());
    }

  private:
    float sine_ = 0, cosine_ = 0;
    Carrier turns_;  // e^{−ims} by column
};

// Returns amplitude(F, x) of all pixels, clamped to [0, 1].
template <class Amplitude>
Array<float, 2> amplitudes(View<const Complex, 2> field, const Amplitude& amplitude) {
    Array<float, 2> values(field.shape());
    work::parallel_for(field.extent(0), [&](std::size_t y) {
        for (std::size_t x = 0; x < field.extent(1); ++x)
            values(y, x) = std::clamp(amplitude(field(y, x), x), 0.0f, 1.0f);
    });
    return values;
}

}  // namespace

double band_along_x(View<const Complex, 2> field) {
    const std::size_t width = field.extent(1);
    const math::Fft2 fft(1, width);
    std::vector<double> power(width / 2 + 1);
    Array<Complex, 2> row({1, width});
    double total = 0;
    for (std::size_t y = 0; y < field.extent(0); ++y) {
        std::copy_n(&field(y, 0), width, row.data());
        fft.forward(row);
        for (std::size_t j = 0; j < width; ++j) {
            power[std::min(j, width - j)] += std::norm(row.data()[j]);
            total += std::norm(row.data()[j]);
        }
    }
    double within = 0;
    for (std::size_t j = 0; j < power.size(); ++j) {
        within += power[j];
        if (within >= share_within_band * total) return (static_cast<double>(j) + 0.5) / static_cast<double>(width);
    }
    return 0.5;
}

Array<float, 2> encode_amplitude(View<const Complex, 2> field, const PatternOptions& options, double wavelength,
                                 CarriedOrder& order) {
    const double band = band_along_x(field), pitch = options.modulator.pitch;
    const std::size_t columns = options.encoding == Encoding::burckhardt ? 3
                                : options.encoding == Encoding::lee      ? 4
                                                                         : 0;
    order.frequency = columns > 0 ? column_carrier(band, columns, pitch) : reference_carrier(band, options, wavelength);
    order.clearance = clearance_around(order.frequency, band, options.encoding);
    order.angle = std::asin(std::min(1.0, order.frequency * wavelength / pitch));
    for (std::size_t x = 0; x < field.extent(1); ++x)
        order.carrier.push_back(
            Complex(std::polar(1.0, -2 * std::numbers::pi * std::fmod(order.frequency * static_cast<double>(x), 1.0))));

    if (columns > 0) return amplitudes(field, Components(columns, field.extent(1)));
    const auto fringe = [&](Complex value, std::size_t x) { return optics::times(value, order.carrier[x]); };
    if (options.encoding == Encoding::intensity)
        return amplitudes(field, [&](Complex value, std::size_t x) { return std::norm(1.0f + fringe(value, x)) / 4; });
    if (options.encoding == Encoding::bipolar)
        return amplitudes(field, [&](Complex value, std::size_t x) { return 0.5f * (1 + fringe(value, x).real()); });
    return amplitudes(field, [&](Complex value, std::size_t x) { return fringe(value, x).real() > 0 ? 1.0f : 0.0f; });
}

}  // namespace hogel::patterns
