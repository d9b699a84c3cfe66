// SPDX-License-Identifier: Apache-2.0
#include "hogel/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/math/fft.h"
#include "hogel/work/parallel.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;
using std::numbers::pi;

Field read_all(const FieldSource& source) {
    Field field(source.grid());
    const Grid& plane = source.grid().plane;
    source.read({0, 0, plane.width, plane.height}, 0, field.samples);
    field.set_provenance(source.provenance());
    return field;
}

double x_of(const Grid& plane, std::size_t column) {
    return plane.center_x + (static_cast<double>(column) + 0.5 - static_cast<double>(plane.width) / 2) * plane.pitch_x;
}
double y_of(const Grid& plane, std::size_t row) {
    return plane.center_y + (static_cast<double>(plane.height) / 2 - static_cast<double>(row) - 0.5) * plane.pitch_y;
}

template <class Phase>
void multiply_phase(Field& field, const Phase& phase) {
    const Grid& plane = field.grid().plane;
    work::parallel_for(plane.height, [&](std::size_t row) {
        const double y = y_of(plane, row);
        for (std::size_t column = 0; column < plane.width; ++column)
            field.samples(row, column) *=
                Complex(std::polar(1.0, std::remainder(phase(x_of(plane, column), y), 2 * pi)));
    });
}

void subtract_mean(Array<Complex, 2>& samples) {
    std::complex<double> mean = 0;
    for (const Complex& sample : samples.elements()) mean += std::complex<double>(sample);
    mean /= static_cast<double>(samples.size());
    for (Complex& sample : samples.elements()) sample -= Complex(mean);
}

// Returns the frequency of an index of a transform, cycles per sample.
double frequency(std::size_t index, std::size_t count) {
    const auto position = static_cast<double>(index), n = static_cast<double>(count);
    return (position < n / 2 ? position : position - n) / n;
}

struct Peak {
    double x = 0, y = 0;
};

// Returns the brightest diffraction order in one half of the spectrum, away from zero. Sums the power over cells of
// frequencies, so that a single bright frequency in noise counts less than an order.
Peak brightest_order(View<const Complex, 2> spectrum, bool right) {
    constexpr std::size_t cells = 64;           // across the spectrum
    constexpr double zero_order_radius = 0.05;  // radius of the undiffracted light around zero, cycles per sample
    const std::size_t height = spectrum.extent(0), width = spectrum.extent(1);
    const double sign = right ? 1 : -1;
    Array<double, 2> light({cells, cells});
    const auto cell_of = [](double f) {
        return std::min(cells - 1, static_cast<std::size_t>((f + 0.5) * static_cast<double>(cells)));
    };
    Array<double, 2> sum_x = light, sum_y = light;
    for (std::size_t row = 0; row < height; ++row)
        for (std::size_t column = 0; column < width; ++column) {
            // Mirrors the left half of the spectrum: both orders of real holograms are equal.
            const double fx = sign * frequency(column, width), fy = -sign * frequency(row, height);
            const bool in_half = fx > 0 || (fx == 0 && fy > 0);
            if (std::hypot(fx, fy) < zero_order_radius || !in_half) continue;
            const double power = std::norm(spectrum(row, column));
            const std::size_t i = cell_of(fy), j = cell_of(fx);
            light(i, j) += power;
            sum_x(i, j) += power * fx;
            sum_y(i, j) += power * fy;
        }
    // Mean frequency of the light in the brightest block of 3 × 3 cells.
    Peak best;
    double max_power = -1;
    for (std::size_t i = 0; i < cells; ++i)
        for (std::size_t j = 0; j < cells; ++j) {
            double power = 0, x = 0, y = 0;
            for (std::size_t k = i == 0 ? 0 : i - 1; k < std::min(cells, i + 2); ++k)
                for (std::size_t l = j == 0 ? 0 : j - 1; l < std::min(cells, j + 2); ++l) {
                    power += light(k, l);
                    x += sum_x(k, l);
                    y += sum_y(k, l);
                }
            if (power <= max_power) continue;
            max_power = power;
            best = power > 0 ? Peak{sign * x / power, sign * y / power} : Peak{};
        }
    return best;
}

// Returns the transmission of a soft aperture: 1 inside, falling to 0 over the last tenth of the radius.
double soft_aperture(double distance, double radius) {
    const double inside = (radius - distance) / (0.1 * radius);
    return inside >= 1 ? 1 : inside <= 0 ? 0 : 0.5 - 0.5 * std::cos(pi * inside);
}

// Cuts out an order and shifts it to zero frequency by whole frequency steps, which is exact.
void isolate_order(Array<Complex, 2>& spectrum, SelectedOrder& order) {
    const std::size_t height = spectrum.extent(0), width = spectrum.extent(1);
    const auto shift = [](double f, std::size_t n) {
        const auto steps = static_cast<std::ptrdiff_t>(std::lround(f * static_cast<double>(n)));
        return static_cast<std::size_t>(steps + static_cast<std::ptrdiff_t>(2 * n)) % n;
    };
    const std::size_t offset_x = shift(order.frequency_x, width), offset_y = shift(-order.frequency_y, height);
    order.frequency_x = frequency(offset_x, width);
    order.frequency_y = -frequency(offset_y, height);
    Array<Complex, 2> moved(spectrum.shape());
    for (std::size_t row = 0; row < height; ++row)
        for (std::size_t column = 0; column < width; ++column) {
            const double f = std::hypot(frequency(column, width), frequency(row, height));
            const double weight = soft_aperture(f, order.radius);
            if (weight > 0)
                moved(row, column) = spectrum((row + offset_y) % height, (column + offset_x) % width) *
                                     static_cast<float>(weight / static_cast<double>(width * height));
        }
    spectrum = std::move(moved);
}

// Transforms a field along both axes: ∫ e^{−2πi x·X/(λ·length)} dx, where `length` may be negative.
Field transformed(Field field, double length) {
    const FieldGrid in = field.grid();
    const Grid& plane = in.plane;
    const auto pitch = [&](std::size_t count, double step) {
        return in.wavelength * std::abs(length) / (static_cast<double>(count) * step);
    };
    Field out({{plane.width, plane.height, pitch(plane.width, plane.pitch_x), pitch(plane.height, plane.pitch_y), 0, 0},
               in.wavelength});
    // Samples are at (j + ½ − N/2) of both pitches: a transform with phase ramps before and after it.
    const double sign = length > 0 ? -1 : 1;
    const auto ramp = [&](std::size_t i, std::size_t n) {
        return sign * 2 * pi * static_cast<double>(i) * (0.5 - static_cast<double>(n) / 2) / static_cast<double>(n);
    };
    const auto apply_ramps = [&](Array<Complex, 2>& samples) {
        work::parallel_for(plane.height, [&](std::size_t y) {
            for (std::size_t x = 0; x < plane.width; ++x)
                samples(y, x) *=
                    Complex(std::polar(1.0, std::remainder(ramp(x, plane.width) + ramp(y, plane.height), 2 * pi)));
        });
    };
    apply_ramps(field.samples);
    const math::Fft2 fft(plane.height, plane.width);
    if (length > 0)
        fft.forward(field.samples);
    else
        fft.backward(field.samples);
    apply_ramps(field.samples);
    const auto half = [](std::size_t n) {
        const double offset = 0.5 - static_cast<double>(n) / 2;
        return offset * offset / static_cast<double>(n);
    };
    // 1/(iλ length) and the constant part of the ramps.
    const std::complex<double> factor = plane.pitch_x * plane.pitch_y /
                                        (std::complex<double>(0, 1) * in.wavelength * length) *
                                        std::polar(1.0, sign * 2 * pi * (half(plane.width) + half(plane.height)));
    work::parallel_for(field.samples.size() / plane.width, [&](std::size_t y) {
        for (std::size_t x = 0; x < plane.width; ++x)
            out.samples(y, x) = Complex(std::complex<double>(field.samples(y, x)) * factor);
    });
    out.set_provenance(field.provenance());
    return out;
}

}  // namespace

SelectedOrder select_order(const FieldSource& hologram, const OrderSelection& selection, const Progress& progress) {
    const core::StopScope scope(progress);
    using Which = OrderSelection::Which;
    SelectedOrder order{read_all(hologram)};
    Array<Complex, 2>& samples = order.field.samples;
    if (selection.without_mean) subtract_mean(samples);
    if (selection.reference_source) {
        const Vec3 source = *selection.reference_source;
        if (source.z == 0)
            throw Error(ErrorCode::usage, "reference_source",
                        "the source of the reference wave must not be in the plane of the hologram");
        const double k = (source.z < 0 ? 2 : -2) * pi / order.field.grid().wavelength;
        multiply_phase(order.field,
                       [&](double x, double y) { return k * std::hypot(x - source.x, y - source.y, source.z); });
    }
    const std::size_t height = samples.extent(0), width = samples.extent(1);
    const math::Fft2 fft(height, width);
    fft.forward(samples);
    progress.report(0.4);
    order.frequency_x = selection.frequency_x;
    order.frequency_y = selection.frequency_y;
    if (selection.which == Which::center) order.frequency_x = order.frequency_y = 0;
    if (selection.which == Which::right || selection.which == Which::left) {
        const Peak peak = brightest_order(samples, selection.which == Which::right);
        order.frequency_x = peak.x;
        order.frequency_y = peak.y;
    }
    const double carrier = std::hypot(order.frequency_x, order.frequency_y);
    constexpr double full_radius = 0.75;  // beyond the corners of the spectrum, including the soft edge
    order.radius = selection.radius > 0 ? selection.radius : carrier > 0 ? carrier / 2 : full_radius / 0.9;
    if (!(std::abs(order.frequency_x) <= 0.5 && std::abs(order.frequency_y) <= 0.5) || !std::isfinite(order.radius))
        throw Error(ErrorCode::usage, "order",
                    fmt::format("an order at {:.4g}, {:.4g} cycles per sample lies beyond half a cycle per sample",
                                order.frequency_x, order.frequency_y));
    if (order.radius * static_cast<double>(std::min(width, height)) < 1)
        throw Error(
            ErrorCode::usage, "aperture",
            fmt::format("an aperture with a radius of {:.4g} cycles per sample contains no frequency", order.radius));
    isolate_order(samples, order);
    fft.backward(samples);
    progress.report(1);
    return order;
}

Field fourier_image(const FieldSource& hologram, double focal_length, const Progress& progress) {
    const core::StopScope scope(progress);
    if (!(std::isfinite(focal_length) && focal_length > 0))
        throw Error(ErrorCode::usage, "focal",
                    fmt::format("the focal length of the lens is {} m, but must be positive and finite", focal_length));
    Field image = transformed(read_all(hologram), focal_length);
    progress.report(1);
    return image;
}

Field fresnel_image(const FieldSource& hologram, double distance, const Progress& progress) {
    const core::StopScope scope(progress);
    if (!(std::isfinite(distance) && distance != 0))
        throw Error(ErrorCode::usage,
                    fmt::format("the distance of the image is {} m, but must be finite and not zero", distance));
    Field field = read_all(hologram);
    const double k = pi / (field.grid().wavelength * distance);
    const auto chirp = [&](double x, double y) { return k * (x * x + y * y); };
    multiply_phase(field, chirp);
    Field image = transformed(std::move(field), distance);
    multiply_phase(image, chirp);
    progress.report(1);
    return image;
}

}  // namespace hogel
