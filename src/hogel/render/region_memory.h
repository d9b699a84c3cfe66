// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/array.h"
#include "hogel/render/oblique_triangle.h"
#include "hogel/render/row_axes.h"

namespace hogel::render {

// The shapes of renderers' depth buffers for a region of hogels, with one NearestTriangle per sample.

/// [v][u][t][s]: the inner loops of `simplex` run over hogels.
inline Shape<4> simplex_buffer(const LightFieldGrid& grid, const HogelRange& region) {
    return {grid.directions_v, grid.directions_u, region.nt, region.ns};
}

/// [slow hogels][fast hogels][fast directions]: the rays of one V.
inline Shape<3> simploid_buffer(const RowAxes& axes, const HogelRange& region) {
    return {axes.slow_hogels(region), axes.fast_hogels(region), axes.fast_directions()};
}

/// [v][u][s]: one row of hogels.
inline Shape<3> simplex3d_buffer(const LightFieldGrid& grid, const HogelRange& region) {
    return {grid.directions_v, grid.directions_u, region.ns};
}

/// [t][s]: one direction.
inline Shape<2> oblique_buffer(const HogelRange& region) { return {region.nt, region.ns}; }

/// The size of such a buffer in bytes, as a floating-point number because a region may exceed any memory.
template <std::size_t rank>
double buffer_bytes(const Shape<rank>& shape) {
    double product = sizeof(NearestTriangle);
    for (const std::size_t extent : shape) product *= static_cast<double>(extent);
    return product;
}

}  // namespace hogel::render
