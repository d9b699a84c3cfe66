// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/image.h"

namespace hogel::view {

/// Numbers as colours from dark blue over green to yellow, whose lightness rises evenly, so that they are told apart
/// without colours too. @param low, high  the numbers of the first colour and the last
Image heat_map(const Array<double, 2>& numbers, double low, double high);

}  // namespace hogel::view
