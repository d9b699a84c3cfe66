// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hogel/exchange/geometry.h"

namespace hogel::exchange {

/// Returns lines of text about the effects of a parallax of more than one hogel from view to view on photographs and
/// holograms of each method, and sufficient numbers of views.
std::vector<std::string> sparse_views(const LightFieldGrid& grid, double parallax);

}  // namespace hogel::exchange
