// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hogel/render/epi/clusters.h"

namespace hogel::render::epi {

/// Epipolar planes of one row of hogels, for adjacent directions. Plane i is y = row + (slope + i · step) (z − z0).
/// Columns n_first to n_last see it at (x + shift, z − z0) in directions K_first to K_last (EpipolarFrame,
/// EpipolarPlane).
struct RowPlanes {
    double row, z0, slope, step;
    std::size_t count;  ///< number of planes, from 1 to max_planes
    double shift, n_first, n_last, K_first, K_last;

    static constexpr std::size_t max_planes = 256;
};

/// Bit mask of the triangles of a cluster that a plane may cross.
struct CrossedTriangles {
    std::uint64_t triangles;
    std::uint32_t cluster;
};

/// Triangles that each plane may cross, in the order of the clusters.
using CrossedByPlane = std::vector<std::vector<CrossedTriangles>>;

/// Finds all triangles that may be visible in each of these planes. The result is conservative: it contains every
/// triangle that a plane crosses (set_up_spans) and draw_spans draws. About 0.1 % are false positives, more near z =
/// z0. The plain and the vector version return the same bits.
void find_crossed_plain(const TriangleClusters& clusters, const RowPlanes& planes, CrossedByPlane& crossed);
extern decltype(find_crossed_plain)& find_crossed;

bool may_show(const ClusterBox& box, const RowPlanes& planes);

/// Converts quantised ClusterHeights to plane indices: (y, z), relative to (row, z0), is in plane y · R + `first` with
/// R = `per_slope` / z.
struct HeightScale {
    float y, y_step, z, z_step, per_slope, first;
    /// The uncertainty of a plane index is error |R| + rounding.
    float error, rounding;
    /// If |R| ≥ max_R, z may be 0 within its error. All planes have |y| ≤ max_slope |z| + error.
    float max_R, max_slope;

    HeightScale(const ClusterBox& box, const RowPlanes& planes);
};

}  // namespace hogel::render::epi
