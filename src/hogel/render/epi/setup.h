// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

/// Epipolar plane that cuts triangles: y = row + slope z, seen at (x + shift, z − z0) (EpipolarFrame).
struct CutPlane {
    double row, slope, shift, z0;
    double depth_per_z;  ///< ζ in metres for each unit of z
};

constexpr EpiSpan empty_span{1e30f, 1, 1e30f, 1};

/// Where the two ends of a span lie on its triangle: end 0 on the edge from corner `lone` to corner `next`, end 1 on
/// the edge from `lone` to the third corner (TriangleCut).
struct SpanOrigin {
    float weight0, weight1;  ///< of the lone corner, at the two ends
    std::uint32_t triangle;
    std::uint16_t lone, next;  ///< 0, 1 or 2

    /// Returns the weights of the triangle's vertices at a position, from 0 at end 0 to 1 at end 1.
    std::array<float, 3> weights(float position) const {
        std::array<float, 3> b;
        b[lone] = (1 - position) * weight0 + position * weight1;
        b[next] = (1 - position) * (1 - weight0);
        b[3 - lone - next] = position * (1 - weight1);
        return b;
    }
};

/// Cuts the triangles in these slots of the clusters and writes a span for each. The plane crosses a triangle if it
/// separates its corners; a corner is below if (y − slope z) − row < 0. Triangles that are not crossed get
/// `empty_span`. Both versions give the same bits.
/// @param spans, values, origins  arrays of slots.size(); `origins` may be null
void set_up_spans_plain(const TriangleClusters& clusters, std::span<const std::uint32_t> slots, const CutPlane& plane,
                        EpiSpan* spans, SpanValues* values, SpanOrigin* origins);
extern decltype(set_up_spans_plain)& set_up_spans;

}  // namespace hogel::render::epi
