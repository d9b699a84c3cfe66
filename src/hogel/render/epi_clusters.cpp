#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi_clusters_internal.h"

namespace hogel {
namespace {

// Spreads the low 21 bits of a number to every third bit.
std::uint64_t every_third_bit(std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

// Triangles along a Morton curve through their middles: neighbours on the curve are neighbours in space.
std::vector<std::uint32_t> morton_order(const ShadedScene& scene) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    for (const Vec3& p : scene.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 size = high - low;
    const double scale = 0x1fffff / std::max({size.x, size.y, size.z, std::numeric_limits<double>::min()});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    keyed.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const auto [a, b, c] = scene.triangles[i].vertices;
        const Vec3 middle = (scene.positions[a] + scene.positions[b] + scene.positions[c]) / 3;
        const auto cell = [scale](double along) {
            return every_third_bit(static_cast<std::uint64_t>(std::max(0.0, scale * along)));
        };
        keyed.emplace_back(cell(middle.x - low.x) | cell(middle.y - low.y) << 1 | cell(middle.z - low.z) << 2,
                           static_cast<std::uint32_t>(i));
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::uint32_t> order;
    order.reserve(keyed.size());
    for (const auto& [key, index] : keyed) order.push_back(index);
    return order;
}

}  // namespace

TriangleClusters::TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame)
    : triangles(morton_order(scene)) {
    const std::size_t count = (triangles.size() + cluster_size - 1) / cluster_size;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr Bounds empty{infinity, -infinity, infinity, -infinity, infinity, -infinity};
    corners.resize(count);
    others.resize(triangles.size());
    bounds.assign(count, empty);
    groups.assign((count + group_size - 1) / group_size, {empty, {}});
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t cluster = i / cluster_size, place = i % cluster_size;
        const auto& vertices = scene.triangles[triangles[i]].vertices;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3 p = frame.in_samples(scene.positions[vertices[corner]]);
            corners[cluster].y[corner][place] = p.y;
            corners[cluster].z[corner][place] = p.z;
            others[i].x[corner] = p.x;
            others[i].radiance[corner] = scene.radiance[vertices[corner]];
            for (Bounds* box : {&bounds[cluster], &groups[cluster / group_size].bounds})
                *box = {std::min(box->x_low, p.x),  std::max(box->x_high, p.x), std::min(box->y_low, p.y),
                        std::max(box->y_high, p.y), std::min(box->z_low, p.z),  std::max(box->z_high, p.z)};
        }
    }
    for (std::uint32_t cluster = 0; cluster < count; ++cluster)
        groups[cluster / group_size].clusters.push_back(cluster);
    for (Group& group : groups)
        std::stable_sort(group.clusters.begin(), group.clusters.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return bounds[a].z_low < bounds[b].z_low; });
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.bounds.z_low < b.bounds.z_low; });
}

}  // namespace hogel
