// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene/shapes.h"

/// Dimensions and parts of the pool table. Lengths are arbitrary: the cloth is the plane y = 0, 2.4 long and 1.28 wide.
namespace hogel::showpieces {

inline constexpr double half_length = 1.2, half_width = 0.64;
inline constexpr double rail_top = 0.075, floor_height = -0.78;

/// Returns the frame that carries cloth and rails, from its skirt to the inner edge of the rails. A closed surface.
Mesh frame();
Mesh cloth();
/// Returns the cushions between the pockets, with mitred ends. Their nose is above the middle of the balls.
Mesh cushions();
Mesh pocket_nets();
/// Returns the inlays of mother-of-pearl in the rails.
Mesh sights();
/// Returns the turned legs under the corners and the middle of the frame.
Mesh legs();

}  // namespace hogel::showpieces
