#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/sample_store_internal.h"

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

// The clusters of triangles in that order, nearest first, are what is left in `order`: whole ones, and the rest of the
// last at the end.
void sort_clusters(std::vector<std::uint32_t>& order, const ShadedScene& scene, const EpipolarFrame& frame) {
    std::vector<std::pair<double, std::size_t>> nearest(order.size() / cluster_size);
    for (std::size_t cluster = 0; cluster < nearest.size(); ++cluster) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = cluster * cluster_size; i < (cluster + 1) * cluster_size; ++i)
            for (const std::uint32_t vertex : scene.triangles[order[i]].vertices)
                least = std::min(least, frame.in_samples(scene.positions[vertex]).z);
        nearest[cluster] = {least, cluster};
    }
    std::sort(nearest.begin(), nearest.end());
    std::vector<std::uint32_t> sorted;
    sorted.reserve(order.size());
    const auto append = [&](std::size_t begin, std::size_t end) {
        sorted.insert(sorted.end(), order.begin() + static_cast<std::ptrdiff_t>(begin),
                      order.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (const auto& [least, cluster] : nearest) append(cluster * cluster_size, (cluster + 1) * cluster_size);
    append(nearest.size() * cluster_size, order.size());
    order = std::move(sorted);
}

}  // namespace

void ClusterBounds::resize(std::size_t count) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::size_t most_lanes = 32;
    const std::size_t filled = (count + most_lanes - 1) / most_lanes * most_lanes;
    for (Numbers* low : {&x_low, &y_low, &z_low}) low->assign(filled, infinity);
    for (Numbers* high : {&x_high, &y_high, &z_high}) high->assign(filled, -infinity);
}

void ClusterBounds::include(std::size_t i, const Vec3& p) {
    x_low[i] = std::min(x_low[i], p.x);
    x_high[i] = std::max(x_high[i], p.x);
    y_low[i] = std::min(y_low[i], p.y);
    y_high[i] = std::max(y_high[i], p.y);
    z_low[i] = std::min(z_low[i], p.z);
    z_high[i] = std::max(z_high[i], p.z);
}

TriangleClusters::TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame, std::size_t channels)
    : triangles(morton_order(scene)) {
    sort_clusters(triangles, scene, frame);
    const std::size_t count = (triangles.size() + cluster_size - 1) / cluster_size;
    corners.resize(count);
    others.resize(triangles.size());
    bounds.resize(count);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t cluster = i / cluster_size, place = i % cluster_size;
        const auto& vertices = scene.triangles[triangles[i]].vertices;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3 p = frame.in_samples(scene.positions[vertices[corner]]);
            corners[cluster].y[corner][place] = p.y;
            corners[cluster].z[corner][place] = p.z;
            others[i].x[corner] = p.x;
            const Rgb radiance = scene.radiance[vertices[corner]];
            others[i].radiance[corner] = channels == 1 ? Rgb{luminance(radiance), 0, 0} : radiance;
            bounds.include(cluster, p);
        }
    }
}

}  // namespace hogel
