// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "hogel/array.h"

namespace hogel::codec::format {

// Transforms R, G, B into luminance and two channels of chrominance, and back, in place. It is the orthonormal DCT of
// three points, so that errors keep their energy. A single channel is unchanged.
void separate_colours(View<float, 5> radiance);
void join_colours(View<float, 5> radiance);
// As above on one thread, for three arrays of equal size.
void separate_colours(std::span<float> a, std::span<float> b, std::span<float> c);
void join_colours(std::span<float> a, std::span<float> b, std::span<float> c);

}  // namespace hogel::codec::format
