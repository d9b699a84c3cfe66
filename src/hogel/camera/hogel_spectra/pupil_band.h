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

/// The samples of an eye's band to a hogel, along an axis.
std::size_t band_samples_per_hogel(const HogelLayout& hogels, const camera::Viewpoint& eye);

/// Whether computing so many samples of a band costs less than those of the hogels: at most half as many along an axis.
/// A band that is nearly as dense as the samples saves nothing.
inline bool band_is_cheaper(std::size_t per_hogel, const HogelLayout& hogels) {
    return 4 * per_hogel * per_hogel <= hogels.across() * hogels.down();
}

/// The band of an eye, of the light of a range of hogels.
class PupilBand {
  public:
    /// Bands of several eyes; none where one of them is not cheaper than samples.
    static std::vector<PupilBand> of(const HogelLayout& hogels, const HogelRange& range,
                                     std::span<const camera::Viewpoint> eyes);

    const camera::narrow_band::BandGrid& grid() const { return grid_; }
    SlepianBases bases() const { return {*across_, *down_}; }
    std::size_t nodes() const { return across_->nodes(); }
    std::size_t per_hogel() const { return per_hogel_; }
    /// By how much the demodulation's frequency grows over a hogel, in cycles per hogel.
    double bend() const { return bend_; }
    /// Samples of the band that so many hogels light, along an axis.
    std::size_t samples(std::size_t hogels) const {
        return (hogels + overlap_ - 1) * per_hogel_ + 2 * across_->before();
    }

    /// Sets a view, which may be that of a hogel beside, to a hogel as the eye sees it.
    void view(const HogelLayout& hogels, std::size_t s, std::size_t t, HogelView& view) const;

    /// The phases e^{ik|x−c|} of the demodulation, with the eye at c, at the samples of a part of the band.
    /// @param x, y    the first sample
    /// @param phases  [row][part][column], a multiple of `lanes` columns
    void demodulation(std::size_t x, std::size_t y, View<float, 3> phases) const;

  private:
    explicit PupilBand(const camera::ViewGeometry& geometry) : grid_{geometry, {}} {}
    stereogram::InBandRows near(double frequency, std::size_t waves) const;

    camera::narrow_band::BandGrid grid_;
    std::shared_ptr<const SlepianBasis> across_, down_;
    std::size_t per_hogel_ = 0, overlap_ = 1;
    double bend_ = 0;
    double reach_ = 0;  // waves on either side of the eye's direction that count, across and down
};

}  // namespace hogel::camera::hogel_spectra
