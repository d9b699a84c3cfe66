// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/film/film.h"
#include "hogel/photograph.h"

namespace hogel::optics {

/// The light that enters the widest pupil of one eye. Photographs with any focus and any smaller pupil need nothing
/// else, so each costs one transform of the film per look, and the hologram is not read again. Memory: a sixteenth of
/// the eye's band, about (1.1 D A/λR)² values per look, with D the side of the hologram, A the pupil and R the
/// distance.
class CapturedEye {
  public:
    /// Throws Error(usage) for another eye, a wider pupil or a farther focus than those captured.
    Image photograph(const Camera& camera) const;

    Vec3 eye() const { return eye_; }

  private:
    friend std::vector<CapturedEye> capture(const FieldSource&, std::span<const Camera>, const PhotographOptions&,
                                            const Progress&);
    CapturedEye(const FieldGrid& hologram, const narrow_band::BandGrid& band, double pupil, double blur)
        : plane_(hologram.plane),
          eye_(band.geometry.eye()),
          pupil_(pupil),
          blur_(blur),
          film_(band, hologram, pupil, blur) {}

    Grid plane_;
    Vec3 eye_;
    double pupil_, blur_;
    film::Film film_;
    std::vector<Array<std::complex<float>, 2>> looks_;  // waves over the pupil
};

/// Captures the eyes of a set of cameras, which bound all later ones. Returns one captured eye for every different eye,
/// in the order of first occurrence, for its widest pupil and its farthest focus. Eyes share passes over the hologram
/// as far as the options' memory allows. Throws Error(usage) as photograph() does.
std::vector<CapturedEye> capture(const FieldSource& hologram, std::span<const Camera> cameras,
                                 const PhotographOptions& options = {}, const Progress& progress = {});

}  // namespace hogel::optics
