// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

/// An epipolar plane: y = row + slope z, seen at (x + shift, z − z0) (EpipolarFrame).
struct PlanePlace {
    double row, slope, shift, z0;
    double depth;  ///< ζ in metres of a step forward
};

/// Covers nothing.
constexpr Strip nowhere{1e30f, 1, 1e30f, 1};

/// Where a strip lies on its triangle. One corner of the triangle is alone on its side of the plane; end 0 lies between
/// it and the next corner, end 1 between it and the last (TriangleCut).
struct StripOrigin {
    float weight0, weight1;  ///< of the lone corner, at the two ends
    std::uint32_t triangle;
    std::uint16_t lone, next;  ///< 0, 1 or 2

    /// Of the triangle's vertices, at this part of the way from end 0 to end 1.
    std::array<float, 3> weights(float part) const {
        std::array<float, 3> b;
        b[lone] = (1 - part) * weight0 + part * weight1;
        b[next] = (1 - part) * (1 - weight0);
        b[3 - lone - next] = part * (1 - weight1);
        return b;
    }
};

/// Cuts triangles, given by their places in the clusters, and writes a strip for each. The plane crosses a triangle if
/// it separates its corners, of which those are below with (y − slope z) − row < 0; others get Strip nowhere.
/// The twins give the same bits.
/// @param origins  may be null
void set_up_plain(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlanePlace& plane,
                  Strip* strips, StripShades* shades, StripOrigin* origins);
void set_up(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlanePlace& plane,
            Strip* strips, StripShades* shades, StripOrigin* origins);

}  // namespace hogel::render::epi
