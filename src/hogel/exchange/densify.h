// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/exchange/disparity.h"
#include "hogel/exchange/geometry.h"

namespace hogel::exchange {

/// The set with factor - 1 views between neighbours, interpolated by their disparity: each pixel is looked up in the
/// two or four views around it that see it, between pixels by cubic interpolation, in the codes that are stored. Views
/// of the set stay as they are.
/// @param memory  bytes of decoded views that are kept
ViewSet densified(ViewSet set, std::shared_ptr<const Disparities> disparities, std::size_t factor, double memory);

/// The same cameras with factor - 1 between neighbours.
void densify(Placement& placement, std::size_t factor);

}  // namespace hogel::exchange
