// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/tilt.h"

#include <array>
#include <cmath>

#include "hogel/optics/low_pass.h"
#include "hogel/optics/spectrum_steps.h"
#include "hogel/work/parallel.h"

namespace hogel::optics {
namespace {

using Complex = std::complex<float>;

// The low-pass as an interpolation kernel of ten taps, tabulated by the fraction of a sample.
class Kernel {
  public:
    static constexpr std::ptrdiff_t taps = 10, before = 4;

    Kernel() {
        for (std::size_t phase = 0; phase <= phases; ++phase)
            for (std::ptrdiff_t k = 0; k < taps; ++k)
                weights_[phase][static_cast<std::size_t>(k)] = static_cast<float>(
                    LowPass::at(static_cast<double>(k - before) - static_cast<double>(phase) / double(phases)));
    }
    const std::array<float, 10>& at(double fraction) const {
        return weights_[static_cast<std::size_t>(fraction * double(phases) + 0.5)];
    }

  private:
    static constexpr std::size_t phases = 2048;
    std::array<std::array<float, 10>, phases + 1> weights_;
};

// Returns the value interpolated at a fractional position; samples outside the array are zero.
Complex interpolated(View<const Complex, 2> samples, const Kernel& kernel, double row, double column) {
    const double row0 = std::floor(row), column0 = std::floor(column);
    const auto& down = kernel.at(row - row0);
    const auto& across = kernel.at(column - column0);
    const auto j0 = static_cast<std::ptrdiff_t>(row0) - Kernel::before;
    const auto i0 = static_cast<std::ptrdiff_t>(column0) - Kernel::before;
    const auto height = static_cast<std::ptrdiff_t>(samples.extent(0));
    const auto width = static_cast<std::ptrdiff_t>(samples.extent(1));
    float re = 0, im = 0;
    for (std::ptrdiff_t b = std::max<std::ptrdiff_t>(0, -j0); b < std::min(Kernel::taps, height - j0); ++b)
        for (std::ptrdiff_t a = std::max<std::ptrdiff_t>(0, -i0); a < std::min(Kernel::taps, width - i0); ++a) {
            const Complex& value = samples(j0 + b, i0 + a);
            const float weight = down[static_cast<std::size_t>(b)] * across[static_cast<std::size_t>(a)];
            re += weight * value.real();
            im += weight * value.imag();
        }
    return {re, im};
}

void require_axes(const Orientation& plane) {
    constexpr double tolerance = 1e-9;
    if (std::abs(length(plane.x) - 1) < tolerance && std::abs(length(plane.y) - 1) < tolerance &&
        std::abs(dot(plane.x, plane.y)) < tolerance)
        return;
    throw Error(ErrorCode::usage, "a tilted plane's axes must be unit vectors at right angles");
}

}  // namespace

Spectrum tilt(const Spectrum& spectrum, const Orientation& plane, const Grid& window, const Band& band,
              const ScratchOptions& scratch) {
    require_axes(plane);
    static const Kernel kernel;
    Spectrum result = empty_spectrum(window, spectrum.wavelength, band, 0.5 * (band.low_x + band.high_x),
                                     0.5 * (band.low_y + band.high_y), scratch);
    result.window.center_x = spectrum.window.center_x;
    result.window.center_y = spectrum.window.center_y;
    const double frequency = 1 / spectrum.wavelength;
    work::parallel_for(result.height(), [&](std::size_t row) {
        const double fy = result.frequency_y(static_cast<double>(row));
        for (std::size_t column = 0; column < result.width(); ++column) {
            const double fx = result.frequency_x(static_cast<double>(column));
            const double square = frequency * frequency - fx * fx - fy * fy;
            if (square <= 0) continue;
            const double fz = std::sqrt(square);
            const Vec3 in_old_frame = fx * plane.x + fy * plane.y + fz * plane.z();
            if (in_old_frame.z <= 0) continue;
            const double row_position =
                -in_old_frame.y * spectrum.window.size_y() - static_cast<double>(spectrum.first_row);
            const double column_position =
                in_old_frame.x * spectrum.window.size_x() - static_cast<double>(spectrum.first_column);
            if (row_position < -Kernel::taps || row_position > static_cast<double>(spectrum.height()) + Kernel::taps ||
                column_position < -Kernel::taps ||
                column_position > static_cast<double>(spectrum.width()) + Kernel::taps)
                continue;
            result.samples.view()(row, column) =
                static_cast<float>(in_old_frame.z / fz) *
                interpolated(spectrum.samples.view(), kernel, row_position, column_position);
        }
    });
    return result;
}

}  // namespace hogel::optics
