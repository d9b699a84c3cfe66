// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/optics/film/film.h"
#include "hogel/photograph.h"

namespace hogel::optics {

/// The light that enters the widest pupil of one eye. Photographs of any focus and any smaller pupil need nothing else,
/// so each takes a transform of the film a look, and the hologram is not read again. It takes a sixteenth of
/// the eye's band: about (1.1 D A/λR)² values a look, D the side of the hologram and A the pupil.
class CapturedEye {
  public:
    /// Throws Error(usage) for another eye, a wider pupil or a focus farther off than what was captured.
    Image photograph(const Camera& camera) const;

    Vec3 eye() const { return eye_; }

  private:
    friend std::vector<CapturedEye> capture(const FieldSource&, std::span<const Camera>, const PhotographOptions&,
                                            const Progress&);
    CapturedEye(const FieldGrid& hologram, const narrow_band::NarrowBand& band, double pupil, double blur)
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

/// Reads a hologram for a set of cameras, which represent all later ones: one captured eye for every different
/// eye among them, in the order in which these first come, with its widest pupil and its farthest focus. All eyes share
/// passes over the hologram as far as the options' memory allows. Throws Error(usage) as photograph() does.
std::vector<CapturedEye> capture(const FieldSource& hologram, std::span<const Camera> cameras,
                                 const PhotographOptions& options = {}, const Progress& progress = {});

}  // namespace hogel::optics
