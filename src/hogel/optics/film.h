#pragma once

#include <memory>
#include <vector>

#include "hogel/image/camera.h"
#include "hogel/image/image.h"
#include "hogel/math/fft.h"
#include "hogel/optics/narrow_band.h"

namespace hogel {

/// From one eye's narrow band to photographs: a resampling to direction sines, in which the pupil is the Fourier
/// transform's own plane whatever the obliquity; one transform to the pupil; and for each focus and pupil size a mask,
/// a defocus phase and a transform back to the film (docs/notation.md section 4).
class Film {
  public:
    /// @param cameras  all have the band's eye; their pupils are at most the one that the band was made for
    Film(const NarrowBand& band, const FieldGrid& hologram, std::span<const Camera> cameras);
    ~Film();
    Film(Film&&) noexcept;

    /// The intensities on the film of one look, [camera][sample]: squared moduli in the film's own sampling.
    std::vector<Array<float, 2>> expose(View<const std::complex<float>, 2> band) const;

    /// A camera's picture, in radiance, from intensities that were averaged over looks.
    Image develop(std::size_t camera, View<const float, 2> intensity) const;

  private:
    struct Lens;
    struct SineGrid {
        std::size_t size_x = 0, size_y = 0;  ///< samples, the transform's size
        double first_x = 0, first_y = 0;     ///< sine of the first sample; n_x grows with the column, n_y with the row
        double step = 0;                     ///< between samples
    };

    Array<std::complex<float>, 2> resample(View<const std::complex<float>, 2> band) const;
    SineGrid choose_grid(std::span<const Camera> cameras) const;
    double least_slope() const;  ///< of the sines over the hologram, per metre

    NarrowBand band_;
    FieldGrid hologram_;
    SineGrid sines_;
    std::unique_ptr<Fft2> fft_;
    std::vector<Lens> lenses_;
};

}  // namespace hogel
