// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/render/epi/clusters.h"
#include "hogel/render/sample_store.h"

namespace hogel::render::epi {
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

// Returns whether the back of a triangle is visible in the middle direction of a face.
bool faces_away(const ShadedScene& scene, const EpipolarFrame& frame, std::uint32_t triangle) {
    const auto& [a, b, c] = scene.triangles[triangle].vertices;
    const Vec3 corner_a = frame.in_samples(scene.positions[a]);
    const Vec3 to_b = frame.in_samples(scene.positions[b]) - corner_a,
               to_c = frame.in_samples(scene.positions[c]) - corner_a;
    return to_b.x * to_c.y - to_b.y * to_c.x < 0;
}

// Orders triangles along a Morton curve through their centroids, which keeps neighbours in space together. Fronts come
// before backs, so that the two sides of a wall are in different clusters.
std::vector<std::uint32_t> morton_order(const ShadedScene& scene, const EpipolarFrame& frame) {
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
        const auto cell = [scale](double length) {
            return every_third_bit(static_cast<std::uint64_t>(std::max(0.0, scale * length)));
        };
        const auto triangle = static_cast<std::uint32_t>(i);
        keyed.emplace_back(std::uint64_t{faces_away(scene, frame, triangle)} << 63 | cell(middle.x - low.x) |
                               cell(middle.y - low.y) << 1 | cell(middle.z - low.z) << 2,
                           triangle);
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::uint32_t> order;
    order.reserve(keyed.size());
    for (const auto& [key, index] : keyed) order.push_back(index);
    return order;
}

// Sorts the full clusters of `order`: fronts before backs, each group from front to back. The triangles of the
// incomplete cluster stay at the end. Returns the number of clusters that show fronts.
std::size_t sort_clusters(std::vector<std::uint32_t>& order, const ShadedScene& scene, const EpipolarFrame& frame) {
    struct Key {
        bool away;
        double min_z;
        std::size_t cluster;
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys(order.size() / cluster_size);
    for (std::size_t cluster = 0; cluster < keys.size(); ++cluster) {
        const std::size_t first = cluster * cluster_size;
        double min_z = std::numeric_limits<double>::infinity();
        for (std::size_t i = first; i < first + cluster_size; ++i)
            for (const std::uint32_t vertex : scene.triangles[order[i]].vertices)
                min_z = std::min(min_z, frame.in_samples(scene.positions[vertex]).z);
        keys[cluster] = {faces_away(scene, frame, order[first]), min_z, cluster};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> sorted;
    sorted.reserve(order.size());
    const auto append = [&](std::size_t begin, std::size_t end) {
        sorted.insert(sorted.end(), order.begin() + static_cast<std::ptrdiff_t>(begin),
                      order.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (const auto& [away, min_z, cluster] : keys) append(cluster * cluster_size, (cluster + 1) * cluster_size);
    append(keys.size() * cluster_size, order.size());
    order = std::move(sorted);
    return static_cast<std::size_t>(std::ranges::count(keys, false, &Key::away));
}

std::uint16_t steps_from(double low, double high, double value) {
    if (!(low < high)) return 0;
    return static_cast<std::uint16_t>(std::lround((value - low) / (high - low) * ClusterHeights::steps));
}

}  // namespace

void ClusterBox::include(const Vec3& p) {
    x_low = std::min(x_low, p.x);
    x_high = std::max(x_high, p.x);
    y_low = std::min(y_low, p.y);
    y_high = std::max(y_high, p.y);
    z_low = std::min(z_low, p.z);
    z_high = std::max(z_high, p.z);
}

TriangleClusters::TriangleClusters(const ShadedScene& scene, const EpipolarFrame& frame, std::size_t channels)
    : triangles(morton_order(scene, frame)), fronts(sort_clusters(triangles, scene, frame)) {
    const std::size_t count = (triangles.size() + cluster_size - 1) / cluster_size;
    heights.resize(count);
    corners.resize(triangles.size());
    boxes.resize(count);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& vertices = scene.triangles[triangles[i]].vertices;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3 p = frame.in_samples(scene.positions[vertices[corner]]);
            const Rgb radiance = scene.radiance[vertices[corner]];
            corners[i].x[corner] = p.x;
            corners[i].y[corner] = p.y;
            corners[i].z[corner] = p.z;
            corners[i].radiance[corner] = channels == 1 ? Rgb{luminance(radiance), 0, 0} : radiance;
            boxes[i / cluster_size].include(p);
        }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t cluster = i / cluster_size, slot = i % cluster_size;
        const ClusterBox& box = boxes[cluster];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            heights[cluster].y[corner][slot] = steps_from(box.y_low, box.y_high, corners[i].y[corner]);
            heights[cluster].z[corner][slot] = steps_from(box.z_low, box.z_high, corners[i].z[corner]);
        }
    }
}

}  // namespace hogel::render::epi
