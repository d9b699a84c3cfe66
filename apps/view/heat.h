// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/image.h"

namespace hogel::view {

/// Maps numbers to colours from dark blue over green to yellow with evenly rising lightness.
/// @param low, high  numbers of the first and the last colour
Image heat_map(const Array<double, 2>& numbers, double low, double high);

}  // namespace hogel::view
