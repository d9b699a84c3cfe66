// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "hogel/optics/propagation/tile_plan.h"

namespace hogel::optics::propagation {

/// Transfer function of a tile: e^{2πi f_z z}, the fade of directions that do not lead to the output, and the
/// quadrature weights of the integral over the band.
class Transfer {
  public:
    explicit Transfer(const TilePlan& plan);

    /// Multiplies one column of frequencies, i.e. those with the same f_x.
    void multiply(std::size_t column, std::span<std::complex<float>> values) const;
    /// Energy of a column: in all directions, and in directions below min_cosine.
    struct Energy {
        double all = 0, grazing = 0;
    };
    Energy energy(std::size_t column, std::span<const std::complex<float>> values) const;
    /// Returns the relative output error for a field of noise, caused by the fade and the band edges.
    double error() const { return error_; }

  private:
    class Column;
    TilePlan plan_;
    std::vector<std::complex<double>> weights_x_, weights_y_;
    double error_ = 0;
};

}  // namespace hogel::optics::propagation
