// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/render/oblique_triangle.h"

namespace hogel::render {

/// Returns the bytes of a depth buffer with one NearestTriangle per sample; double, because it may exceed any memory.
template <std::size_t rank>
double buffer_bytes(const Shape<rank>& shape) {
    double product = sizeof(NearestTriangle);
    for (const std::size_t extent : shape) product *= static_cast<double>(extent);
    return product;
}

}  // namespace hogel::render
