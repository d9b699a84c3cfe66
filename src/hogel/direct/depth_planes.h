// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/direct/scene_points.h"

namespace hogel::direct {

/// A depth slice of a scene, near ≤ ζ ≤ far, metres. Its light is emitted from the plane in its middle.
struct Slice {
    double near, far;
    double depth() const { return 0.5 * (near + far); }
};

/// Cuts a scene into `count` ≥ 1 slices of equal thickness, nearest to the viewer first; a flat scene into one.
std::vector<Slice> slices_of(const ShadedScene& scene, std::size_t count);

/// Draws slices by rays parallel to the hologram's axis.
class SliceDrawing {
  public:
    explicit SliceDrawing(const ShadedScene& scene) : scene_(scene), visibility_(scene) {}

    /// The field that a slice emits, sampled on its plane, and its mask. The field is √L λ/δ with random phases, where
    /// δ is the pitch: a diffuse surface of radiance L. The mask is 1 where the slice is solid, otherwise 0.
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
