// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "hogel/array.h"
#include "hogel/field.h"
#include "hogel/focus.h"
#include "hogel/math/fft.h"

namespace hogel::optics {

/// Number, sum and sum of squares of the values, for each entry of FocusSearch::Contrasts.
struct LightSums {
    FocusSearch::Contrasts count = {}, light = {}, squares = {};

    void add(const LightSums& other);
    /// Returns the variances divided by the squared means; 0 without light.
    FocusSearch::Contrasts contrasts() const;
};

/// Plane-wave spectrum of a part of a field, for refocusing to parallel planes. Light that leaves the part wraps
/// around.
class PlaneWaves {
  public:
    /// Reads the region of the field at look 0.
    PlaneWaves(const FieldSource& field, const Region& region);

    /// Returns the sums of the intensity at a depth, metres behind the field, by backward propagation.
    LightSums at(double depth) const;

    /// Returns half the bandwidth, cycles per metre, that contains nine tenths of the amplitudes: the mean of x and y.
    double band() const;

  private:
    LightSums sums_of(const Array<std::complex<float>, 2>& wave) const;

    FieldGrid grid_;
    std::size_t width_, height_;
    math::Fft2 fft_;
    Array<std::complex<float>, 2> spectrum_;
};

}  // namespace hogel::optics
