// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/light_field.h"
#include "hogel/shading.h"

namespace hogel::render::simplex {

/// The four-dimensional depth buffer without simplices ([K] 7.2.2, future work there): the simploid that a triangle
/// sweeps is sliced whole, first at each V, then at each t, and what is left is a strip in the plane (s, U), scan
/// converted as it is. Gives what `simplex` gives.
std::unique_ptr<LightFieldSource> make_simploid_renderer(std::shared_ptr<const ShadedScene> scene,
                                                         const LightFieldGrid& grid);

}  // namespace hogel::render::simplex
