// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hogel/patterns/pupils/film.h"
#include "hogel/patterns/pupils/rays.h"

namespace hogel::patterns {

/// Sums over the samples of a photograph by waves, of amplitudes A, and of the photograph by rays, of amplitudes B.
struct PhotographSums {
    double ab = 0, aa = 0, bb = 0;
    std::size_t samples = 0;
    void operator+=(const PhotographSums& other) {
        ab += other.ab;
        aa += other.aa;
        bb += other.bb;
        samples += other.samples;
    }
    /// Returns the factor of A that minimises Σ(factor A − B)².
    double factor() const { return aa > 0 ? ab / aa : 0; }
};

/// Photographs through pupils behind a modulator, by rays of a light field and by waves of patterns. Patterns that are
/// shown in turn add their intensities.
class PupilCamera {
  public:
    /// Throws Error(usage) as PupilRays does, and for directions that the modulator does not show.
    PupilCamera(const LightFieldSource& light_field, std::size_t channel, double wavelength,
                const Modulator& modulator);

    const PupilRange& range() const { return rays_.range(); }
    /// Returns the sine of the angle per cycle per pixel: λ over the pixel pitch.
    double per_cycle() const { return wavelength_ / pixel_pitch_; }
    const PupilFilm& film(const Pupil& pupil) const { return films_[pupil.size]; }
    /// Computes the amplitudes B = √L of the photograph by rays.
    void photograph_rays(const Pupil& pupil, Array<float, 2>& amplitudes) const;
    /// Computes the field behind the pupil for each pattern, from the patterns' spectra, and their mean intensity.
    void photograph_waves(std::span<const Array<std::complex<float>, 2>> spectra, const Pupil& pupil,
                          std::vector<Array<std::complex<float>, 2>>& fields, Array<float, 2>& intensity) const;
    /// Adds the adjoint of one pattern's photograph to `spectrum`. Overwrites `field`.
    void add_adjoint(Array<std::complex<float>, 2>& field, const Pupil& pupil,
                     View<std::complex<float>, 2> spectrum) const {
        film(pupil).add_adjoint(field, pupil, wavelength_, spectrum);
    }
    /// Returns the part of the film whose light comes from the modulator in all of the pupil's directions.
    Region interior(const Pupil& pupil) const;
    /// Returns the sums over the interior.
    PhotographSums sums(const Pupil& pupil, View<const float, 2> intensity, View<const float, 2> amplitudes) const;

  private:
    PupilRays rays_;
    double wavelength_, pixel_pitch_;
    std::vector<PupilFilm> films_;  // by Pupil::size
};

}  // namespace hogel::patterns
