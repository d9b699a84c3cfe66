// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hogel/render/epi/clusters.h"

namespace hogel::render::epi {

/// Epipolar planes of one row of hogels, for adjacent directions. Plane i is y = row + (slope + i · step) (z − z0),
/// seen at (x + shift, z − z0) by columns n_first to n_last in directions K_first to K_last (EpipolarFrame,
/// EpipolarPlane).
struct RowPlanes {
    double row, z0, slope, step;
    std::size_t count;  ///< of planes, from 1 to max_planes
    double shift, n_first, n_last, K_first, K_last;

    static constexpr std::size_t max_planes = 256;
};

/// The triangles of a cluster that a plane may cross: bit i for triangle i.
struct CrossedTriangles {
    std::uint64_t triangles;
    std::uint32_t cluster;
};

/// For each plane the triangles that it may cross, in the order of the clusters.
using CrossedByPlane = std::vector<std::vector<CrossedTriangles>>;

/// Finds all triangles that may be visible in each of these planes. The result is conservative: no triangle is missing
/// that a plane crosses (set_up_spans) and draw_spans draws. About one in a thousand is a false positive, more where z
/// ≈ z0. The twins give the same bits.
void find_crossed_plain(const TriangleClusters& clusters, const RowPlanes& planes, CrossedByPlane& crossed);
extern decltype(find_crossed_plain)& find_crossed;

/// Whether a ray of these planes may meet a cluster's box.
bool may_show(const ClusterBox& box, const RowPlanes& planes);

/// Converts quantised ClusterHeights to numbers of planes: a point (y, z), relative to (row, z0), is in plane number y
/// · R + `first` with R = `per_slope` / z.
struct HeightScale {
    float y, y_step, z, z_step, per_slope, first;
    /// The uncertainty of a plane's number is error |R| + rounding.
    float error, rounding;
    /// From this |R| on, z may be 0 within its error; all planes have |y| ≤ max_slope |z| + error.
    float max_R, max_slope;

    HeightScale(const ClusterBox& box, const RowPlanes& planes);
};

}  // namespace hogel::render::epi
