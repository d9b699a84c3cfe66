// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hogel/camera/hogel_spectra/project.h"
#include "hogel/camera/hogel_spectra/slepian_basis.h"
#include "hogel/camera/pupil_band_source.h"
#include "hogel/light_field.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::camera::hogel_spectra {

using stereogram::HogelLayout;

/// Returns the number of samples of a viewpoint's band per hogel, along an axis.
std::size_t band_samples_per_hogel(const HogelLayout& hogels, const camera::Viewpoint& viewpoint);

/// Returns whether a band of `per_hogel` samples per hogel costs less than the hogels' samples: if it has at most half
/// as many samples along an axis. A band that is nearly as dense as the samples saves nothing.
inline bool band_is_cheaper(std::size_t per_hogel, const HogelLayout& hogels) {
    return 4 * per_hogel * per_hogel <= hogels.across() * hogels.down();
}

/// Geometry and bases of the pupil band of a viewpoint, for a range of hogels.
class PupilBand {
  public:
    /// Returns the bands of several viewpoints. Returns an empty vector if one of them costs more than the hogels'
    /// samples.
    static std::vector<PupilBand> create(const HogelLayout& hogels, const HogelRange& range,
                                         std::span<const camera::Viewpoint> viewpoints);

    const camera::narrow_band::BandGrid& grid() const { return grid_; }
    SlepianBases bases() const { return {*across_, *down_}; }
    std::size_t nodes() const { return across_->nodes(); }
    std::size_t per_hogel() const { return per_hogel_; }
    /// Returns the change of the demodulation's frequency over the width of a hogel, in cycles per hogel.
    double bend() const { return bend_; }
    /// Returns the number of samples of the band that `hogels` adjacent hogels reach, along an axis.
    std::size_t samples(std::size_t hogels) const {
        return (hogels + overlap_ - 1) * per_hogel_ + 2 * across_->before();
    }

    /// Sets a view to that of hogel (s, t). It keeps the weights of the view's previous hogel where they are the same.
    void view(const HogelLayout& hogels, std::size_t s, std::size_t t, HogelView& view) const;

    /// Computes the phases e^{ik|x−c|} of the demodulation, with the viewpoint c, at the samples of a part of the band.
    /// @param x, y    the first sample
    /// @param phases  [row][part][column], a multiple of `lanes` columns
    void demodulation(std::size_t x, std::size_t y, View<float, 3> phases) const;

  private:
    explicit PupilBand(const camera::ViewGeometry& geometry) : grid_{geometry, {}} {}
    stereogram::InBandRows in_band(double frequency, std::size_t waves) const;

    camera::narrow_band::BandGrid grid_;
    std::shared_ptr<const SlepianBasis> across_, down_;
    std::size_t per_hogel_ = 0, overlap_ = 1;
    double bend_ = 0;
    double half_width_ = 0;  // half the width of the in-band waves, in waves, across and down
};

}  // namespace hogel::camera::hogel_spectra
