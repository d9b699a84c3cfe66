// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "hogel/math/fft.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/patterns/pupils/pupil.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {

/// Samples of the photographs through pupils of one radius, on the whole area of the modulator. Sample (0, 0) is at the
/// centre of pixel (0, 0), and the samples are dense enough for the intensity of the light that the pupil passes.
class PupilFilm {
  public:
    PupilFilm(const Modulator& modulator, double radius);

    std::size_t rows() const { return fft_.height(); }
    std::size_t columns() const { return fft_.width(); }
    Shape<2> shape() const { return {rows(), columns()}; }
    /// Returns x of a column and y of a row, metres, from the centre of the modulator.
    double x(std::size_t column) const;
    double y(std::size_t row) const;
    double pitch_x() const { return static_cast<double>(pixels_x_) * pitch_ / static_cast<double>(columns()); }
    double pitch_y() const { return static_cast<double>(pixels_y_) * pitch_ / static_cast<double>(rows()); }

    /// Computes the field in the plane in focus behind a pupil, from the spectrum of the field at the modulator. The
    /// mean of its intensity does not depend on the pupil's radius for a spectrum of uniform density.
    void photograph(View<const std::complex<float>, 2> spectrum, const Pupil& pupil, double wavelength,
                    Array<std::complex<float>, 2>& field) const;
    /// The adjoint of photograph(): adds its spectrum to `spectrum`. Overwrites `field`.
    void add_adjoint(Array<std::complex<float>, 2>& field, const Pupil& pupil, double wavelength,
                     View<std::complex<float>, 2> spectrum) const;

    /// Returns the frequency, in cycles over the area of the modulator, of a column or row 0 of the film's transform.
    std::ptrdiff_t first_x(const Pupil& pupil) const { return first(pupil.aperture.x, pixels_x_, columns()); }
    std::ptrdiff_t first_y(const Pupil& pupil) const { return first(pupil.aperture.y, pixels_y_, rows()); }
    /// Calls visit(row, column, factor) for the rows and columns of the film's transform that the pupil passes, row by
    /// row on all threads. The factor is `scale` times the pupil's transmission, with its edge one frequency wide,
    /// times the propagation to the plane in focus.
    template <class Visit>
    void for_frequencies(const Pupil& pupil, double wavelength, double scale, const Visit& visit) const;
    /// Transforms the film's transform into the field.
    void transform(Array<std::complex<float>, 2>& field) const { fft_.backward(field); }

  private:
    double scale(const Pupil& pupil) const;  // see photograph()
    static std::ptrdiff_t first(double middle, std::size_t pixels, std::size_t samples) {
        return static_cast<std::ptrdiff_t>(std::lround(middle * static_cast<double>(pixels))) -
               static_cast<std::ptrdiff_t>(samples / 2);
    }

    std::size_t pixels_x_, pixels_y_;
    double pitch_;
    math::Fft2 fft_;
};

template <class Visit>
void PupilFilm::for_frequencies(const Pupil& pupil, double wavelength, double scale, const Visit& visit) const {
    const auto width = static_cast<double>(pixels_x_), height = static_cast<double>(pixels_y_);
    const Aperture& aperture = pupil.aperture;
    const std::ptrdiff_t left = first_x(pupil), top = first_y(pupil),
                         right = left + static_cast<std::ptrdiff_t>(columns());
    const double per_cycle = wavelength / pitch_, depth = pupil.focus / wavelength;
    const double softness = std::sqrt(width * height);  // the pupil's edge is one frequency wide
    const auto squared = [](double value) { return value * value; };
    work::parallel_for(rows(), [&](std::size_t row) {
        const double fy = static_cast<double>(top + static_cast<std::ptrdiff_t>(row)) / height, dy = fy - aperture.y;
        const double half = std::sqrt(std::max(0.0, squared(aperture.radius + 1 / softness) - squared(dy)));
        const auto from = std::max(static_cast<std::ptrdiff_t>(std::ceil((aperture.x - half) * width)), left);
        const auto until = std::min(static_cast<std::ptrdiff_t>(std::floor((aperture.x + half) * width)), right - 1);
        if (until < from) return;
        const auto cycles = [&](double i) {  // of a wave that is followed to depth ζ, where z is −ζ
            const double gx = (static_cast<double>(from) + i) / width - pupil.axis_x, gy = fy - pupil.axis_y;
            return -depth * (std::sqrt(std::max(0.0, 1 - squared(per_cycle) * (gx * gx + gy * gy))) - 1);
        };
        optics::walk_phase(
            static_cast<std::size_t>(until - from + 1), cycles, [&](std::size_t i, std::complex<double> phasor) {
                const std::ptrdiff_t column = from + static_cast<std::ptrdiff_t>(i);
                const double dx = static_cast<double>(column) / width - aperture.x;
                const double passed = std::clamp((aperture.radius - std::hypot(dx, dy)) * softness + 0.5, 0.0, 1.0);
                visit(row, static_cast<std::size_t>(column - left), std::complex<float>(scale * passed * phasor));
            });
    });
}

}  // namespace hogel::patterns
