// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene/shapes.h"

/// What the parts of the pool table share. Lengths are arbitrary: the cloth is the plane y = 0, 2.4 long and 1.28 wide.
namespace hogel::showpieces {

inline constexpr double half_length = 1.2, half_width = 0.64;
inline constexpr double rail_top = 0.075, floor_height = -0.78;

/// Closed: the frame that carries cloth and rails, from its skirt to the inner edge of the rails.
Mesh frame();
Mesh cloth();
/// Rubber under cloth between the pockets, its nose above the middle of the balls, cut off slantwise.
Mesh cushions();
Mesh pocket_nets();
/// Mother-of-pearl, on the rails.
Mesh sights();
/// Turned, under the corners and the middle.
Mesh legs();

}  // namespace hogel::showpieces
