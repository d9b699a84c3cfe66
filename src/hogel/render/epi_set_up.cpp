#include <algorithm>
#include <cmath>

#include "hogel/render/epi_cut_internal.h"
#include "hogel/render/epi_set_up_internal.h"

namespace hogel {

void clusters_crossed_plain(const ClusterBounds& bounds, const PlaneRays& rays, std::vector<std::uint32_t>& crossed) {
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const auto [x_low, x_high, y_low, y_high, z_low, z_high] = bounds[i];
        const auto [ahead, behind] = std::minmax({rays.slope * z_low, rays.slope * z_high});
        if (!((y_low - behind) - rays.row < 0 && (y_high - ahead) - rays.row >= 0)) continue;
        // The columns n = x − K z that see a point of the box.
        const double near = z_low - rays.z0, far = z_high - rays.z0;
        const auto [least, most] =
            std::minmax({rays.K_first * near, rays.K_last * near, rays.K_first * far, rays.K_last * far});
        const double n_low = (x_low + rays.shift) - most, n_high = (x_high + rays.shift) - least;
        // Strips are drawn in single precision.
        const double reach = std::max(std::abs(x_low), std::abs(x_high)) + std::max(std::abs(least), std::abs(most));
        const double margin = 1 + 1e-6 * reach;
        if (n_low - margin <= rays.n_last && n_high + margin >= rays.n_first)
            crossed.push_back(static_cast<std::uint32_t>(i));
    }
}

std::uint64_t crossing_plain(const ClusterCorners& corners, double row, double slope) {
    std::uint64_t crossed = 0;
    for (std::size_t i = 0; i < cluster_size; ++i) {
        const auto below = [&](int corner) { return (corners.y[corner][i] - slope * corners.z[corner][i]) - row < 0; };
        if (below(0) != below(1) || below(1) != below(2)) crossed |= std::uint64_t{1} << i;
    }
    return crossed;
}

void set_up_plain(const TriangleClusters& clusters, std::span<const std::uint32_t> places, const PlaneRays& rays,
                  Strip* strips, StripShades* shades, StripOrigin* origins) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::uint32_t place = places[i];
        const ClusterCorners& all = clusters.corners[place / cluster_size];
        const TriangleCorners& own = clusters.others[place];
        std::array<double, 3> x, z, height;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            x[corner] = own.x[corner];
            z[corner] = all.z[corner][place % cluster_size];
            // As in `crossing`, to the last bit.
            height[corner] = (all.y[corner][place % cluster_size] - rays.slope * z[corner]) - rays.row;
        }
        auto [lone, next, last, end0, end1] = cut_triangle(x, z, height);
        for (Cut* end : {&end0, &end1}) {
            end->x += rays.shift;
            end->z -= rays.z0;
        }
        const auto x0 = static_cast<float>(end0.x), z0 = static_cast<float>(end0.z);
        strips[i] = {x0, z0, static_cast<float>(end1.x), static_cast<float>(end1.z)};
        const auto w0 = static_cast<float>(end0.weight), w1 = static_cast<float>(end1.weight);
        const Rgb value0 = w0 * own.radiance[lone] + (1 - w0) * own.radiance[next];
        const Rgb value1 = w1 * own.radiance[lone] + (1 - w1) * own.radiance[last];
        const auto depth0 = static_cast<float>(end0.z * rays.depth), depth1 = static_cast<float>(end1.z * rays.depth);
        shades[i] = {x0,
                     z0,
                     static_cast<float>(end1.x - end0.x),
                     static_cast<float>(end1.z - end0.z),
                     {value0.r, value0.g, value0.b, depth0},
                     {value1.r - value0.r, value1.g - value0.g, value1.b - value0.b, depth1 - depth0}};
        if (origins)
            origins[i] = {w0, w1, clusters.triangles[place], static_cast<std::uint16_t>(lone),
                          static_cast<std::uint16_t>(next)};
    }
}

}  // namespace hogel
