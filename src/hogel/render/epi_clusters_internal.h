#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/core/array.h"
#include "hogel/render/epi_frame_internal.h"
#include "hogel/shading/shaded_scene.h"

namespace hogel {

/// So many triangles of a cluster fit the bits of one word.
constexpr std::size_t cluster_size = 64;

/// Where the corners of a cluster's triangles are seen from planes of rays, corner by corner.
struct ClusterCorners {
    alignas(64) double y[3][cluster_size], z[3][cluster_size];
};

/// What else is to be known of a triangle that such a plane crosses, in one cache line.
struct alignas(64) TriangleCorners {
    double x[3];
    Rgb radiance[3];
};

/// The triangles of a scene in the units of an EpipolarFrame, neighbours together: in clusters, and clusters in groups.
/// What comes nearest to the viewer comes first, among the groups and among the clusters of a group. The last cluster
/// is filled up with triangles that are a single point, which no ray meets.
struct TriangleClusters {
    /// What a range of triangles lies between.
    struct Bounds {
        double x_low, x_high, y_low, y_high, z_low, z_high;

        /// Whether the plane y = row + slope z may meet what is inside. Exact about rounding: never false for a cluster
        /// one of whose triangles `crossing` reports.
        bool may_cross(double row, double slope) const {
            const double a = slope * z_low, b = slope * z_high;
            const double least = a < b ? a : b, most = a < b ? b : a;
            return (y_low - most) - row < 0 && (y_high - least) - row >= 0;
        }
    };

    static constexpr std::size_t group_size = 4;  ///< clusters

    std::vector<ClusterCorners, CacheLineAllocator<ClusterCorners>> corners;
    std::vector<TriangleCorners, CacheLineAllocator<TriangleCorners>> others;  ///< cluster by cluster
    std::vector<std::uint32_t> triangles;  ///< which triangle of the scene stands in each place
    std::vector<Bounds> bounds;            ///< of the clusters

    struct Group {
        Bounds bounds;
        std::vector<std::uint32_t> clusters;
    };
    std::vector<Group> groups;

    TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame);
};

}  // namespace hogel
