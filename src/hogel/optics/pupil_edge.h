// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::optics {

/// Support of the point spread function on the film, in direction sines. The film of a wave sampled at frequency steps
/// 1/W is periodic with period W, so the support must end before the next period begins.
struct SpreadWindow {
    double flat = 0;  ///< the PSF is kept unchanged up to this distance
    double stop = 0;  ///< and is zero beyond this distance
    double spot = 0;  ///< radius of the geometric PSF out of focus

    /// The support covers the hologram, but at most 128 resolution cells from the rim of the geometric PSF; 0.16 % of
    /// the light falls beyond.
    /// @param span_x, span_y  extent of the hologram, sines
    /// @param blur            diameter of the geometric PSF, sines
    /// @param cell            resolution cell λ/A, sines
    SpreadWindow(double span_x, double span_y, double blur, double cell);

    /// Shrinks the support so that it ends within `room` sines.
    void fit(double room);
};

/// Returns the fraction of a point's light that falls on a hologram but outside the support, for a point at the centre
/// of the hologram. The fraction beyond m resolution cells is 2/π²m, the mean of J₀² + J₁² (Rayleigh).
double light_left_out(const SpreadWindow& window, double span_x, double span_y, double cell);

/// Soft edge of a pupil with a PSF limited to a SpreadWindow. Multiplying the PSF by the window convolves the pupil's
/// disc with the window's Fourier transform. The edge is nearly straight over the width of this transform, so the
/// transmission depends only on the distance from the edge: it is an integral of the transform along one line. The
/// transform is a sinc function times a Kaiser window. It ends at a finite distance, so the transmission is exactly 0
/// or 1 beyond reach().
class PupilEdge {
  public:
    /// @param wavelength  metres
    PupilEdge(const SpreadWindow& window, double wavelength);

    /// Returns the distance from the geometric edge, metres, beyond which the transmission is constant.
    double reach() const { return reach_; }
    /// Returns the amplitude transmission at a point `inside` metres inside the edge.
    double transmission(double inside) const {
        const double position = (inside + reach_) * scale_;
        if (position <= 0) return 0;
        if (position >= static_cast<double>(table_.size() - 1)) return 1;
        const auto index = static_cast<std::size_t>(position);
        const double fraction = position - static_cast<double>(index);
        return table_[index] + fraction * (table_[index + 1] - table_[index]);
    }

  private:
    double reach_ = 0, scale_ = 0;
    std::vector<double> table_;
};

}  // namespace hogel::optics
