// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/frame.h"
#include "hogel/shading.h"

namespace hogel::render::epi {

/// Number of triangles in a cluster: one per bit of a word.
constexpr std::size_t cluster_size = 64;

/// Coordinates y and z of the corners of a cluster's triangles, quantised to 16 bits between the ends of the cluster's
/// box (ClusterBox). Precise enough to find the few planes that may cross a triangle.
struct ClusterHeights {
    static constexpr double steps = 65535;
    alignas(64) std::uint16_t y[3][cluster_size], z[3][cluster_size];
};

/// Triangle data for span set-up, in two cache lines.
struct alignas(64) TriangleCorners {
    double y[3], z[3], x[3];
    Rgb radiance[3];
    float unused[5] = {};  ///< padding, so that four floats can be loaded from each radiance
};

/// Bounding box of a cluster's triangles.
struct ClusterBox {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double x_low = infinity, x_high = -infinity, y_low = infinity, y_high = -infinity, z_low = infinity,
           z_high = -infinity;

    void include(const Vec3& p);
};

/// Triangles of a scene in the units of an EpipolarFrame, grouped into clusters of neighbours, all full except the
/// last. A slot is a triangle's index in this order.
/// Clusters that show their fronts in the middle direction of the light field come first, because they are likely to
/// occlude the others. Clusters that show their backs follow. Each group is sorted from front to back.
struct TriangleClusters {
    std::vector<ClusterHeights, CacheLineAllocator<ClusterHeights>> heights;
    std::vector<TriangleCorners, CacheLineAllocator<TriangleCorners>> corners;  ///< by slot
    std::vector<std::uint32_t> triangles;  ///< [slot]: index of the triangle in the scene
    std::size_t fronts;                    ///< number of clusters that show fronts
    std::vector<ClusterBox> boxes;

    /// @param channels  number of channels of the light field: with one, r of each radiance is its luminance
    TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame, std::size_t channels);

    /// Returns the bit mask of the slots of a cluster that hold a triangle.
    std::uint64_t occupied(std::size_t cluster) const {
        return ~std::uint64_t{0} >> (cluster_size - std::min(cluster_size, triangles.size() - cluster * cluster_size));
    }
};

}  // namespace hogel::render::epi
