// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "hogel/shading.h"

namespace hogel::shading {

// Factors of radiance_at(), for code that interpolates one of them. For a glossy surface the product is approximate,
// because the texture does not colour the gloss.

/// Returns the texture of a triangle that has one, at the point with these weights of the vertices.
Rgb texture_at(const ShadedScene& scene, std::size_t index, float b0, float b1, float b2, const ViewSample& view);

/// Returns the radiance of a point as if the texture were white.
Rgb untextured_radiance_at(const ShadedScene& scene, std::size_t index, const std::array<float, 3>& weights,
                           const ViewSample& view);

}  // namespace hogel::shading
