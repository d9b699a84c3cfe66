// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "hogel/array.h"
#include "hogel/field.h"
#include "hogel/focus.h"
#include "hogel/math/fft.h"

namespace hogel::optics {

/// For each of FocusSearch::Contrasts the number of values, their sum and that of their squares.
struct LightSums {
    FocusSearch::Contrasts count = {}, light = {}, squares = {};

    void add(const LightSums& other);
    /// The variances relative to the mean squared; 0 without light.
    FocusSearch::Contrasts contrasts() const;
};

/// A part of a field as a sum of plane waves, which can be looked at on any parallel plane. What leaves the part at one
/// side comes back at the other.
class PlaneWaves {
  public:
    /// Reads look 0.
    PlaneWaves(const FieldSource& field, const Region& region);

    /// The sums for the intensity at a depth, metres behind the field: waves go back to it.
    LightSums at(double depth) const;

    /// Half the width of the frequencies, cycles a metre, that hold nine tenths of the amplitudes: the mean of both
    /// directions.
    double band() const;

  private:
    LightSums sums_of(const Array<std::complex<float>, 2>& wave) const;

    FieldGrid grid_;
    std::size_t width_, height_;
    math::Fft2 fft_;
    Array<std::complex<float>, 2> spectrum_;
};

}  // namespace hogel::optics
