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
    float unused = 0;  ///< four floats may be read from where a radiance stands
};

/// What the triangles of each cluster lie between. There are as many boxes as fill vectors; those at the end are empty,
/// and no plane crosses them.
struct ClusterBounds {
    struct Box {
        double x_low, x_high, y_low, y_high, z_low, z_high;
    };
    using Numbers = std::vector<double, CacheLineAllocator<double>>;
    Numbers x_low, x_high, y_low, y_high, z_low, z_high;

    std::size_t size() const { return x_low.size(); }
    void resize(std::size_t count);
    Box operator[](std::size_t i) const { return {x_low[i], x_high[i], y_low[i], y_high[i], z_low[i], z_high[i]}; }
    /// Makes box i include a point.
    void include(std::size_t i, const Vec3& p);
};

/// The triangles of a scene in the units of an EpipolarFrame, neighbours together in clusters. The cluster that comes
/// nearest to the viewer is the first. The last place are filled up with triangles that are a single point, which no
/// ray meets.
struct TriangleClusters {
    std::vector<ClusterCorners, CacheLineAllocator<ClusterCorners>> corners;
    std::vector<TriangleCorners, CacheLineAllocator<TriangleCorners>> others;  ///< cluster by cluster
    std::vector<std::uint32_t> triangles;  ///< which triangle of the scene stands in each place
    ClusterBounds bounds;

    /// @param channels  of the light field: with one, r of each radiance is its luminance
    TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame, std::size_t channels);
};

}  // namespace hogel
