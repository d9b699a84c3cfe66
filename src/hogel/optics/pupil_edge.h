// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::optics {

/// How far from the image of a point its light is followed, in direction sines. A film of W sines of a wave that is
/// sampled at frequencies 1/W repeats with the period W, so light must end before it reaches the next copy.
struct SpreadWindow {
    double flat = 0;  ///< all light is kept up to this distance
    double stop = 0;  ///< and none from this distance on
    double spot = 0;  ///< the radius of the image of a point out of focus

    /// Light is followed across the whole hologram, but no farther than 128 resolution cells from the spot of a point,
    /// beyond which is 0.16 % of it.
    /// @param span_x, span_y  sines that the hologram covers
    /// @param blur            the width of a point out of focus, in sines
    /// @param cell            λ/A
    SpreadWindow(double span_x, double span_y, double blur, double cell);

    /// Shrinks the window to stop within `room`.
    void fit(double room);
};

/// The fraction of the light of a point that falls on a hologram but is not followed by a window, for the middle of the
/// hologram: beyond m resolution cells from its image falls 2/π²m, the mean of J₀² + J₁² (Rayleigh).
double light_left_out(const SpreadWindow& window, double span_x, double span_y, double cell);

/// The rim of a pupil whose point spread is limited to a SpreadWindow. The transform of (point spread · window) is the
/// disc convolved with the window's transform; at a rim that is nearly straight over the width of the latter, this is
/// the integral of the one-dimensional transform of the window, a function of the distance from the rim. The window is
/// a rectangle convolved with the transform of a Kaiser window, so the rim is exactly zero and one beyond reach().
class PupilEdge {
  public:
    /// @param wavelength  metres
    PupilEdge(const SpreadWindow& window, double wavelength);

    /// The distance from the geometric rim, metres, from which on the transmission is constant.
    double reach() const { return reach_; }
    /// The amplitude transmission at a point `inside` metres inside of the rim.
    double transmission(double inside) const {
        const double place = (inside + reach_) * scale_;
        if (place <= 0) return 0;
        if (place >= static_cast<double>(table_.size() - 1)) return 1;
        const auto whole = static_cast<std::size_t>(place);
        const double part = place - static_cast<double>(whole);
        return table_[whole] + part * (table_[whole + 1] - table_[whole]);
    }

  private:
    double reach_ = 0, scale_ = 0;
    std::vector<double> table_;
};

}  // namespace hogel::optics
