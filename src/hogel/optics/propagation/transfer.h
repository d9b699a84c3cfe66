// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "hogel/optics/propagation/tile_plan.h"

namespace hogel::optics::propagation {

/// What a tile's frequencies are multiplied by on their way: e^{2πi f_z z}, the fade of directions that do not lead to
/// the output, and the weights of the integral over the band.
class Transfer {
  public:
    explicit Transfer(const TilePlan& plan);

    /// Multiplies one column of frequencies, all at one f_x.
    void multiply(std::size_t column, std::span<std::complex<float>> values) const;
    /// The energy of a column's values, all of them and those at directions below min_cosine.
    struct Energy {
        double all = 0, grazing = 0;
    };
    Energy energy(std::size_t column, std::span<const std::complex<float>> values) const;
    /// The error of noise at the output, from the fade and the edges of the band.
    double error() const { return error_; }

  private:
    class Column;
    TilePlan plan_;
    std::vector<std::complex<double>> weights_x_, weights_y_;
    double error_ = 0;
};

}  // namespace hogel::optics::propagation
