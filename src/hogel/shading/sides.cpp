// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/sides.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "hogel/core/part.h"
#include "hogel/scene/vertices.h"
#include "hogel/shading/lighting.h"
#include "hogel/shading/triangles.h"
#include "hogel/work/parallel.h"

namespace hogel::shading {
namespace {

constexpr std::size_t sides_per_task = 1024;

bool has_sides(const Mesh& mesh) { return mesh.material.double_sided && mesh.radiance.empty(); }

class BackFinder {
  public:
    BackFinder(const Scene& scene, const ShadedScene& shaded)
        : shaded_(shaded),
          caster_(all_triangles(shaded)),
          viewpoint_(viewpoint_of(scene)),
          offset_(ray_offset(scene)) {}

    /// Returns whether the back of a triangle is visible at its middle or near a corner.
    bool is_seen_from_behind(const ShadedScene::Triangle& triangle) const {
        const Vec3 a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
        const Vec3 front = cross(b - a, c - a);
        if (!(length(front) > 0) || dot(front, (a + b + c) / 3 - viewpoint_) <= 0) return false;
        const Vec3 offset = -offset_ / length(front) * front;
        return std::ranges::any_of(
            std::array{(a + b + c) / 3, near_corner(a, b, c), near_corner(b, c, a), near_corner(c, a, b)},
            [&](Vec3 point) { return is_open(point + offset); });
    }

  private:
    static Vec3 viewpoint_of(const Scene& scene) {
        const auto [low, high] = bounds(scene);
        return {0, 0, std::max(high.z, 0.0) + 5 * std::max(high.x - low.x, high.y - low.y)};
    }
    Vec3 corner(const ShadedScene::Triangle& triangle, std::size_t index) const {
        return shaded_.positions[triangle.vertices[index]];
    }
    static Vec3 near_corner(Vec3 corner, Vec3 b, Vec3 c) { return 0.8 * corner + 0.1 * (b + c); }
    bool is_open(Vec3 point) const {
        return !caster_.occluded(point, normalize(viewpoint_ - point), 0, length(viewpoint_ - point));
    }

    const ShadedScene& shaded_;
    trace::RayCaster caster_;
    Vec3 viewpoint_;
    double offset_;
};

/// Returns for each triangle of a shaded scene whether it must be turned.
std::vector<char> find_seen_backs(const Scene& scene, const ShadedScene& shaded) {
    const BackFinder finder(scene, shaded);
    const std::size_t count = shaded.triangles.size();
    std::vector<char> backs(count);
    work::parallel_for((count + sides_per_task - 1) / sides_per_task, [&](std::size_t task) {
        const std::size_t first = task * sides_per_task;
        for (std::size_t i = first; i < std::min(count, first + sides_per_task); ++i)
            backs[i] =
                has_sides(scene.meshes[shaded.triangles[i].mesh]) && finder.is_seen_from_behind(shaded.triangles[i]);
    });
    return backs;
}

/// Adds triangles to a mesh with reversed sides, using new vertices with reversed normals.
class Turner {
  public:
    explicit Turner(Mesh& mesh) : mesh_(mesh) {}
    void add(const std::array<std::uint32_t, 3>& corners) {
        mesh_.triangles.push_back({turned(corners[0]), turned(corners[2]), turned(corners[1])});
    }

  private:
    std::uint32_t turned(std::uint32_t vertex) {
        const auto [known, is_new] = turned_.try_emplace(vertex, 0);
        if (is_new) {
            known->second = scene::add_copy_of_vertex(mesh_, vertex);
            if (!mesh_.normals.empty()) mesh_.normals.back() = -mesh_.normals.back();
        }
        return known->second;
    }

    Mesh& mesh_;
    std::unordered_map<std::uint32_t, std::uint32_t> turned_;
};

}  // namespace

std::optional<Scene> with_seen_sides(const Scene& scene, const ShadedScene& shaded) {
    if (scene.lights.empty() || std::ranges::none_of(scene.meshes, has_sides)) return std::nullopt;
    core::require_part("Embree", "the light on both sides of surfaces");
    const std::vector<char> backs = find_seen_backs(scene, shaded);
    if (std::ranges::count(backs, char{1}) == 0) return std::nullopt;
    Scene turned = scene;
    std::vector<Turner> turners;
    std::vector<std::uint32_t> bases;
    std::uint32_t base = 0;
    for (Mesh& mesh : turned.meshes) {
        bases.push_back(base);
        base += static_cast<std::uint32_t>(mesh.positions.size());
        turners.emplace_back(mesh);
        mesh.triangles.clear();
    }
    for (std::size_t i = 0; i < shaded.triangles.size(); ++i) {
        const auto& [vertices, texture, m] = shaded.triangles[i];
        const std::array<std::uint32_t, 3> corners{vertices[0] - bases[m], vertices[1] - bases[m],
                                                   vertices[2] - bases[m]};
        if (backs[i])
            turners[m].add(corners);
        else
            turned.meshes[m].triangles.push_back(corners);
    }
    return turned;
}

}  // namespace hogel::shading
