// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hogel/exchange/geometry.h"

namespace hogel::exchange {

/// What views do that are so far apart that things move by `parallax` hogels, more than one, from a view to the next:
/// to photographs and to holograms of each method, with the numbers of views that would do. Lines for people.
std::vector<std::string> sparse_views(const LightFieldGrid& grid, double parallax);

}  // namespace hogel::exchange
