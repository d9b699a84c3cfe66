// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "hogel/field.h"
#include "hogel/geometry.h"

namespace hogel::camera {

/// Geometry of a hologram seen from the viewpoint c, the centre of a lens. A point (x, y, 0) is in direction n = (x −
/// c)/r, with direction sines n_x and n_y. Its light to a point δ of the pupil has the frequency n'·δ/λ after
/// demodulation by e^{ikr}.
class ViewGeometry {
  public:
    ViewGeometry(Vec3 eye, double wavelength) : eye_(eye), wavelength_(wavelength) {}

    Vec3 eye() const { return eye_; }
    double wavelength() const { return wavelength_; }
    double distance(double x, double y) const {
        return std::sqrt((x - eye_.x) * (x - eye_.x) + (y - eye_.y) * (y - eye_.y) + eye_.z * eye_.z);
    }
    /// Returns the phase kr of the path from (x, y, 0) to the viewpoint, in cycles.
    double cycles(double x, double y) const { return distance(x, y) / wavelength_; }
    double cosine(double x, double y) const { return eye_.z / distance(x, y); }
    double sine_x(double x, double y) const { return (x - eye_.x) / distance(x, y); }
    double sine_y(double x, double y) const { return (y - eye_.y) / distance(x, y); }

  private:
    Vec3 eye_;
    double wavelength_;
};

}  // namespace hogel::camera
