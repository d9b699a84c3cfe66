#pragma once

#include "hogel/image/camera.h"
#include "hogel/image/image.h"
#include "hogel/math/fft.h"
#include "hogel/optics/narrow_band.h"
#include "hogel/optics/sine_grid.h"

namespace hogel {

/// From one eye's narrow band to photographs: a resampling to direction sines and one transform to the pupil; then for
/// each focus and size of the pupil a mask with a defocus phase, and a transform back to the film (docs/notation.md
/// section 4). Each step works on all threads; an array that the caller gives is all that it needs.
class Film {
  public:
    /// @param blur  the widest defocus_blur() of the cameras that will be used; their pupils are at most the one that
    ///              the band was made for
    Film(const NarrowBand& band, const FieldGrid& hologram, double blur);

    const SineGrid& sines() const { return sines_; }

    /// The wave over the pupil's plane, at the frequencies of a transform of sines() samples.
    Array<std::complex<float>, 2> pupil_wave(View<const std::complex<float>, 2> band) const;

    /// Adds the intensity that a camera's film receives, in the film's own sampling. `field` is room for the work. Both
    /// have the shape of the pupil's wave.
    void expose(View<const std::complex<float>, 2> pupil_wave, const Camera& camera, View<std::complex<float>, 2> field,
                View<float, 2> intensity) const;

    /// Adds a camera's picture, in radiance, of what lies in `shown` of the hologram plane.
    /// @param weight  what the intensities are multiplied by: one over the number of looks that they are the sum of
    void develop(View<const float, 2> intensity, const Camera& camera, const Rectangle& shown, double weight,
                 Image& picture) const;

  private:
    class Lens;

    NarrowBand band_;
    FieldGrid hologram_;
    SineGrid sines_;
    Fft2 fft_;
};

}  // namespace hogel
