// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/math/fft.h"
#include "hogel/optics/narrow_band/narrow_band.h"
#include "hogel/optics/sine_grid.h"

namespace hogel::optics::film {

/// The size of one eye's film.
struct FilmSize {
    SineGrid sines;
    std::ptrdiff_t reach_x = 0, reach_y = 0;  ///< of the pupil, in steps of the transform's frequencies
    std::size_t band_rows = 0;

    FilmSize(const narrow_band::NarrowBand& band, const FieldGrid& hologram, double pupil, double blur);
    /// Bytes of a pupil's wave, and the maximum that Film::pupil_wave() and expose() need in addition to their results.
    double pupil_bytes() const;
    double work_bytes() const;
};

/// From one eye's narrow band to photographs: a resampling to direction sines and one transform to the pupil; then for
/// each focus and size of the pupil a mask with a defocus phase, and a transform back to the film (docs/notation.md
/// section 4). The pupil covers a quarter of the band in x and in y, so its wave is small, and both transforms are
/// limited to it. Each step works on all threads.
class Film {
  public:
    /// @param pupil  the widest of the cameras that will be used, at most that of the band
    /// @param blur   the widest defocus_blur() of these cameras
    Film(const narrow_band::NarrowBand& band, const FieldGrid& hologram, double pupil, double blur);

    const SineGrid& sines() const { return size_.sines; }

    /// The wave over the pupil, [row][column] of frequencies −reach … reach of a transform of sines() samples.
    Array<std::complex<float>, 2> pupil_wave(View<const std::complex<float>, 2> band) const;

    /// Adds the intensity on a camera's film in the film's sampling, [sines().size_y][sines().size_x].
    void expose(View<const std::complex<float>, 2> pupil_wave, const Camera& camera, View<float, 2> intensity) const;

    /// Adds a camera's picture, in radiance, of the part `shown` of the hologram plane.
    /// @param weight  factor of the intensities: the reciprocal of the number of looks that they sum
    void develop(View<const float, 2> intensity, const Camera& camera, const Rectangle& shown, double weight,
                 Image& picture) const;

  private:
    narrow_band::NarrowBand band_;
    FieldGrid hologram_;
    FilmSize size_;
    math::Fft1 along_, down_;
};

}  // namespace hogel::optics::film
