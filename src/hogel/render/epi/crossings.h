// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hogel/render/epi/clusters.h"

namespace hogel::render::epi {

/// Some epipolar planes of one row of hogels, with directions that follow each other: y = row + slope (z − z0), of
/// which the slope of plane i is `slope` + i `step`. They are seen at (x + shift, z − z0) by columns from n_first to
/// n_last in directions from K_first to K_last (EpipolarFrame, EpipolarPlane).
struct RowRays {
    double row, z0, slope, step;
    std::size_t planes;  ///< from 1 to max_planes
    double shift, n_first, n_last, K_first, K_last;

    static constexpr std::size_t max_planes = 256;
};

/// The triangles of a cluster that a plane may cross: bit i for triangle i.
struct Crossing {
    std::uint64_t triangles;
    std::uint32_t cluster;
};

/// Those of each plane, in the order of the clusters.
using Crossings = std::vector<std::vector<Crossing>>;

/// Finds all triangles that show in each of some planes. Exact about rounding: none that a plane separates (`set_up`)
/// and `draw` draws is left out, while one in a thousand is there in vain, or more where z ≈ z0. The twins give the
/// same bits.
void find_crossings_plain(const TriangleClusters& clusters, const RowRays& rays, Crossings& crossings);
void find_crossings(const TriangleClusters& clusters, const RowRays& rays, Crossings& crossings);

/// Whether a ray may meet a cluster's box.
bool may_meet(const ClusterBox& box, const RowRays& rays);

/// How the steps of ClusterHeights are turned into numbers of planes: a point (y, z), counted from the row's own, lies
/// in plane y · R + `first` with R = `per_slope` / z.
struct HeightScale {
    float y, y_step, z, z_step, per_slope, first;
    /// What a plane's number is uncertain by: error |R| + rounding.
    float error, rounding;
    /// Where |R| is as large as that, z may as well be 0, and all planes have |y| ≤ steepest |z| + error.
    float most, steepest;

    HeightScale(const ClusterBox& box, const RowRays& rays);
};

}  // namespace hogel::render::epi
