// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/pupils/film.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/optics/lines.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

using Complex = std::complex<float>;

// Samples along one side: the intensity of a field of bandwidth 2r has the bandwidth 4r.
std::size_t samples_along(std::size_t pixels, double radius) {
    constexpr double guard = 2;  // frequencies beyond the edge of the pupil, on both sides
    const double needed = 4 * radius * static_cast<double>(pixels) + 2 * guard;
    return std::min(pixels, math::good_fft_size(static_cast<std::size_t>(std::ceil(needed))));
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

// Calls visit(row of the film, row of the modulator's spectrum, column of the film, column of the spectrum, factor) for
// all frequencies that the pupil passes, row by row on all threads.
template <class Visit>
void PupilFilm::for_frequencies(const Pupil& pupil, double wavelength, const Visit& visit) const {
    const auto width = static_cast<double>(pixels_x_), height = static_cast<double>(pixels_y_);
    const Aperture& aperture = pupil.aperture;
    const auto middle_x = static_cast<std::ptrdiff_t>(std::lround(aperture.x * width));
    const auto middle_y = static_cast<std::ptrdiff_t>(std::lround(aperture.y * height));
    const double per_cycle = wavelength / pitch_, depth = pupil.focus / wavelength;
    // The pupil's area in frequencies: the mean intensity of the photograph is that of all frequencies.
    const double frequencies = std::numbers::pi * squared(aperture.radius) * width * height;
    const double scale = 1 / std::sqrt(width * height * frequencies);
    const double softness = std::sqrt(width * height);  // the pupil's edge is one frequency wide
    work::parallel_for(rows(), [&](std::size_t row) {
        const std::ptrdiff_t j = middle_y + static_cast<std::ptrdiff_t>(row) - static_cast<std::ptrdiff_t>(rows() / 2);
        const double fy = static_cast<double>(j) / height, dy = fy - aperture.y;
        const double half = std::sqrt(std::max(0.0, squared(aperture.radius + 1 / softness) - squared(dy)));
        const auto from = std::max(static_cast<std::ptrdiff_t>(std::ceil((aperture.x - half) * width)),
                                   middle_x - static_cast<std::ptrdiff_t>(columns() / 2));
        const auto until = std::min(static_cast<std::ptrdiff_t>(std::floor((aperture.x + half) * width)),
                                    middle_x + static_cast<std::ptrdiff_t>((columns() - 1) / 2));
        if (until < from) return;
        const std::size_t spectrum_row = optics::wrapped(j, pixels_y_);
        const auto cycles = [&](double i) {  // of a wave that is followed to depth ζ, where z is −ζ
            const double fx = (static_cast<double>(from) + i) / width;
            return -depth * (std::sqrt(std::max(0.0, 1 - squared(per_cycle) * (fx * fx + fy * fy))) - 1);
        };
        optics::walk_phase(
            static_cast<std::size_t>(until - from + 1), cycles, [&](std::size_t i, std::complex<double> phasor) {
                const std::ptrdiff_t column = from + static_cast<std::ptrdiff_t>(i);
                const double dx = static_cast<double>(column) / width - aperture.x;
                const double passed = std::clamp((aperture.radius - std::hypot(dx, dy)) * softness + 0.5, 0.0, 1.0);
                visit(row, spectrum_row,
                      static_cast<std::size_t>(column - middle_x + static_cast<std::ptrdiff_t>(columns() / 2)),
                      optics::wrapped(column, pixels_x_), Complex(scale * passed * phasor));
            });
    });
}

void PupilFilm::photograph(View<const Complex, 2> spectrum, const Pupil& pupil, double wavelength,
                           Array<Complex, 2>& field) const {
    std::fill_n(field.data(), field.size(), Complex(0));
    for_frequencies(
        pupil, wavelength,
        [&](std::size_t row, std::size_t from_row, std::size_t column, std::size_t from_column, Complex factor) {
            field(row, column) = optics::times(spectrum(from_row, from_column), factor);
        });
    fft_.backward(field);
}

void PupilFilm::add_adjoint(Array<Complex, 2>& field, const Pupil& pupil, double wavelength,
                            View<Complex, 2> spectrum) const {
    fft_.forward(field);
    for_frequencies(
        pupil, wavelength,
        [&](std::size_t row, std::size_t to_row, std::size_t column, std::size_t to_column, Complex factor) {
            spectrum(to_row, to_column) += optics::times(field(row, column), std::conj(factor));
        });
}

}  // namespace hogel::patterns
