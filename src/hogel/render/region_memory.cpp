// SPDX-License-Identifier: Apache-2.0
#include "hogel/renderer.h"

#include "hogel/render/oblique_triangle.h"
#include "hogel/render/region_memory.h"

namespace hogel {

using namespace render;

namespace {

template <std::size_t rank>
double bytes(const Shape<rank>& shape) {
    double product = sizeof(NearestTriangle);
    for (const std::size_t extent : shape) product *= static_cast<double>(extent);
    return product;
}

}  // namespace

double depth_buffer_bytes(std::string_view algorithm, const LightFieldGrid& grid, const HogelRange& region) {
    if (algorithm == "simplex") return bytes(simplex_buffer(grid, region));
    if (algorithm == "simploid") return bytes(simplex_strip_buffer(RowAxes(grid), region));
    if (algorithm == "simplex3d") return bytes(simplex3d_buffer(grid, region));
    if (algorithm == "oblique") return bytes(oblique_buffer(region));
    return 0;
}

}  // namespace hogel
