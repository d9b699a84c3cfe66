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

/// So many triangles of a cluster fit the bits of one word.
constexpr std::size_t cluster_size = 64;

/// Where the corners of a cluster's triangles lie along y and z, corner by corner: in steps from the lower end of the
/// cluster's box (ClusterBox), of which the last leads to its upper end. That is enough to find the few planes that
/// may cross a triangle.
struct ClusterHeights {
    static constexpr double steps = 65535;
    alignas(64) std::uint16_t y[3][cluster_size], z[3][cluster_size];
};

/// All that is to be known of a triangle that a plane of rays crosses, in two cache lines.
struct alignas(64) TriangleCorners {
    double y[3], z[3], x[3];
    Rgb radiance[3];
    float unused[5] = {};  ///< four floats may be read from where a radiance stands
};

/// What the triangles of a cluster lie between.
struct ClusterBox {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double x_low = infinity, x_high = -infinity, y_low = infinity, y_high = -infinity, z_low = infinity,
           z_high = -infinity;

    void include(const Vec3& p);
};

/// The triangles of a scene in the units of an EpipolarFrame, neighbours together in clusters, of which all but the
/// last are full. First come those whose triangles show their fronts to who looks straight at the hologram, which are
/// likely to hide the others, then those that show their backs; of either kind the one that comes nearest to the viewer
/// is the first.
struct TriangleClusters {
    std::vector<ClusterHeights, CacheLineAllocator<ClusterHeights>> heights;
    std::vector<TriangleCorners, CacheLineAllocator<TriangleCorners>> corners;  ///< cluster by cluster
    std::vector<std::uint32_t> triangles;  ///< which triangle of the scene stands in each place
    std::size_t fronts;                    ///< so many clusters show fronts
    std::vector<ClusterBox> boxes;

    /// @param channels  of the light field: with one, r of each radiance is its luminance
    TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame, std::size_t channels);

    /// The places of a cluster that hold a triangle, as bits.
    std::uint64_t filled(std::size_t cluster) const {
        return ~std::uint64_t{0} >> (cluster_size - std::min(cluster_size, triangles.size() - cluster * cluster_size));
    }
};

}  // namespace hogel::render::epi
