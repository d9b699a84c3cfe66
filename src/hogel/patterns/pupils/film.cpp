// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/pupils/film.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/optics/lines.h"
#include "hogel/optics/phase_walk.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;

// Samples along one side: the intensity of a field of bandwidth 2r has the bandwidth 4r.
std::size_t samples_along(std::size_t pixels, double radius) {
    constexpr double guard = 2;  // frequencies beyond the edge of the pupil, on both sides
    const double needed = 4 * radius * static_cast<double>(pixels) + 2 * guard;
    return math::good_fft_size(static_cast<std::size_t>(std::ceil(needed)));
}

double squared(double value) { return value * value; }

}  // namespace

PupilFilm::PupilFilm(const Modulator& modulator, double radius)
    : pixels_x_(modulator.width),
      pixels_y_(modulator.height),
      pitch_(modulator.pitch),
      fft_(samples_along(modulator.height, radius), samples_along(modulator.width, radius)) {}

double PupilFilm::x(std::size_t column) const {
    return static_cast<double>(column) * pitch_x() - 0.5 * (static_cast<double>(pixels_x_) - 1) * pitch_;
}

double PupilFilm::y(std::size_t row) const {
    return 0.5 * (static_cast<double>(pixels_y_) - 1) * pitch_ - static_cast<double>(row) * pitch_y();
}

double PupilFilm::scale(const Pupil& pupil) const {
    const auto width = static_cast<double>(pixels_x_), height = static_cast<double>(pixels_y_);
    // The pupil's area in frequencies: the mean intensity of the photograph is that of all frequencies.
    const double frequencies = std::numbers::pi * squared(pupil.aperture.radius) * width * height;
    return 1 / std::sqrt(width * height * frequencies);
}

void PupilFilm::photograph(View<const Complex, 2> spectrum, const Pupil& pupil, double wavelength,
                           Array<Complex, 2>& field) const {
    std::fill_n(field.data(), field.size(), Complex(0));
    const std::ptrdiff_t left = first_x(pupil), top = first_y(pupil);
    for_frequencies(pupil, wavelength, scale(pupil), [&](std::size_t row, std::size_t column, Complex factor) {
        const std::size_t from_row = optics::wrapped(top + static_cast<std::ptrdiff_t>(row), pixels_y_),
                          from_column = optics::wrapped(left + static_cast<std::ptrdiff_t>(column), pixels_x_);
        field(row, column) = optics::times(spectrum(from_row, from_column), factor);
    });
    transform(field);
}

void PupilFilm::add_adjoint(Array<Complex, 2>& field, const Pupil& pupil, double wavelength,
                            View<Complex, 2> spectrum) const {
    fft_.forward(field);
    const std::ptrdiff_t left = first_x(pupil), top = first_y(pupil);
    for_frequencies(pupil, wavelength, scale(pupil), [&](std::size_t row, std::size_t column, Complex factor) {
        const std::size_t to_row = optics::wrapped(top + static_cast<std::ptrdiff_t>(row), pixels_y_),
                          to_column = optics::wrapped(left + static_cast<std::ptrdiff_t>(column), pixels_x_);
        spectrum(to_row, to_column) += optics::times(field(row, column), std::conj(factor));
    });
}

}  // namespace hogel::patterns
