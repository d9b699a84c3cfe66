// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>

#include "hogel/math/fft.h"
#include "hogel/patterns/pupils/pupil.h"

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

  private:
    template <class Visit>
    void for_frequencies(const Pupil& pupil, double wavelength, const Visit& visit) const;

    std::size_t pixels_x_, pixels_y_;
    double pitch_;
    math::Fft2 fft_;
};

}  // namespace hogel::patterns
