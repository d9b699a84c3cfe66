// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hogel/array.h"

namespace hogel::exchange {

/// Returns a picture [y][x][c] in another size. A pixel is the mean of the part of the picture that it covers.
Array<float, 3> scaled_view(View<const float, 3> picture, std::size_t height, std::size_t width);

}  // namespace hogel::exchange
