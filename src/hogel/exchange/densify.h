// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/exchange/disparity.h"
#include "hogel/exchange/geometry.h"

namespace hogel::exchange {

/// Returns the set with factor - 1 interpolated views between neighbours. Each pixel is fetched by disparity from the
/// surrounding two or four views that see it, with cubic interpolation of the stored codes. Keeps the set's own views.
/// @param memory  bytes of decoded views that are cached
ViewSet densified(ViewSet set, std::shared_ptr<const Disparities> disparities, std::size_t factor, double memory);

/// Inserts factor - 1 cameras between neighbouring cameras.
void densify(Placement& placement, std::size_t factor);

}  // namespace hogel::exchange
