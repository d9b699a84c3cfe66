// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/direct/scene_points.h"

namespace hogel::direct {

/// A slice of a scene, ζ from `near` to `far`, which is drawn on the plane in its middle.
struct Slice {
    double near, far;
    double depth() const { return 0.5 * (near + far); }
};

/// Cuts a scene into slices of equal thickness, nearest to the viewer first.
std::vector<Slice> slices_of(const ShadedScene& scene, std::size_t count);

/// Draws slices by tracing rays along the hologram's axis.
class SliceDrawing {
  public:
    explicit SliceDrawing(const ShadedScene& scene) : scene_(scene), visibility_(scene) {}

    /// The field that a slice emits, on the samples of its plane, and its mask. The field is √L λ/δ with random phases,
    /// δ the pitch, which is a diffuse surface of radiance L. The mask is 1 where the slice is solid, 0 elsewhere.
    struct Drawn {
        Array<std::complex<float>, 2> light;
        Array<float, 2> solid;
        bool empty = true;
    };
    Drawn draw(const Slice& slice, const Grid& plane, double wavelength, const SceneHologramOptions& options) const;

  private:
    const ShadedScene& scene_;
    Visibility visibility_;
};

}  // namespace hogel::direct
