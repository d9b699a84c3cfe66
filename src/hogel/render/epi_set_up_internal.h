#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_kernels_internal.h"

namespace hogel {

/// From clusters to strips, plain and by vectors; the twins give the same bits.

/// The rays of an epipolar plane: y = row + slope z, seen at (x + shift, z − z0) by columns from n_first to n_last in
/// directions from K_first to K_last (EpipolarFrame, EpipolarPlane).
struct PlaneRays {
    double row, slope, shift, z0;
    double n_first, n_last, K_first, K_last;
    double depth;  ///< ζ in metres of a step forward
};

/// Appends the clusters that a ray of the plane may meet to `crossed`, as numbers, in their order. Exact about
/// rounding: a cluster one of whose triangles `crossing` reports, and `draw` draws, is never left out.
void clusters_crossed_plain(const ClusterBounds& bounds, const PlaneRays& rays, std::vector<std::uint32_t>& crossed);
void clusters_crossed(const ClusterBounds& bounds, const PlaneRays& rays, std::vector<std::uint32_t>& crossed);

/// Which triangles of a cluster the plane y = row + slope z separates: bit i for triangle i. A corner is below if
/// (y − slope z) − row < 0.
std::uint64_t crossing_plain(const ClusterCorners& corners, double row, double slope);
std::uint64_t crossing(const ClusterCorners& corners, double row, double slope);

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

/// Cuts triangles, given by their places in the clusters, all of which the plane crosses. Writes a strip for each.
/// @param origins  may be null
void set_up_plain(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlaneRays& rays,
                  Strip* strips, StripShades* shades, StripOrigin* origins);
void set_up(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlaneRays& rays,
            Strip* strips, StripShades* shades, StripOrigin* origins);

}  // namespace hogel
