// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/doubled_faces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "hogel/scene/position_hash.h"
#include "hogel/shading/sides.h"
#include "hogel/work/parallel.h"

namespace hogel::shading {
namespace {

constexpr std::uint32_t none = 0xffffffff;
constexpr std::size_t triangles_per_task = 16384;

bool same(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

class DoubledFaces {
  public:
    explicit DoubledFaces(const ShadedScene& scene) : scene_(scene), removed_(scene.triangles.size()) {
        const std::size_t count = scene.triangles.size();
        hashes_.resize(count);
        work::parallel_for((count + triangles_per_task - 1) / triangles_per_task, [&](std::size_t task) {
            const std::size_t first = task * triangles_per_task;
            for (std::size_t i = first; i < std::min(count, first + triangles_per_task); ++i) {
                const std::array<Vec3, 3> p = corners(i);
                hashes_[i] = static_cast<std::uint32_t>(
                    (scene::position_hash(p[0]) + scene::position_hash(p[1]) + scene::position_hash(p[2])) >> 32);
            }
        });
        table_.assign(std::bit_ceil(2 * count + 1), none);
        for (std::uint32_t i = 0; i < count; ++i) add(i);
    }

    const std::vector<bool>& removed() const { return removed_; }
    bool any() const { return any_; }

  private:
    std::array<Vec3, 3> corners(std::size_t i) const {
        const auto& [a, b, c] = scene_.triangles[i].vertices;
        return {scene_.positions[a], scene_.positions[b], scene_.positions[c]};
    }

    // Compares corners of triangles: 1 if the same with the same winding, −1 with the opposite, 0 if different.
    int likeness(std::size_t i, std::size_t j) const {
        const std::array<Vec3, 3> a = corners(i), b = corners(j);
        for (std::size_t k = 0; k < 3; ++k) {
            if (!same(a[0], b[k])) continue;
            const Vec3 &next = b[(k + 1) % 3], &last = b[(k + 2) % 3];
            if (same(a[1], next) && same(a[2], last)) return 1;
            if (same(a[1], last) && same(a[2], next)) return -1;
        }
        return 0;
    }

    // Returns whether the ray through the middle of the hologram and of the triangle meets its front.
    bool faces_the_middle(std::size_t i) const {
        const auto [a, b, c] = corners(i);
        return dot(cross(b - a, c - a), ray_through_middle((1.0 / 3) * (a + b + c))) < 0;
    }

    // Adds a triangle by linear probing; triangles with the same corners are in one run of the table.
    void add(std::uint32_t i) {
        const std::size_t mask = table_.size() - 1;
        std::size_t position = hashes_[i] & mask;
        for (; table_[position] != none; position = (position + 1) & mask) {
            const std::uint32_t other = table_[position];
            if (hashes_[other] != hashes_[i]) continue;
            const int alike = likeness(other, i);
            if (alike == 0 || (alike < 0 && scene_.fronts_only)) continue;
            any_ = true;
            if (alike > 0 || faces_the_middle(other) || !faces_the_middle(i)) {
                removed_[i] = true;
                return;
            }
            removed_[other] = true;
            table_[position] = i;
            return;
        }
        table_[position] = i;
    }

    const ShadedScene& scene_;
    std::vector<std::uint32_t> hashes_, table_;
    std::vector<bool> removed_;
    bool any_ = false;
};

}  // namespace

void keep_one_of_doubled_faces(ShadedScene& scene) {
    const DoubledFaces doubled(scene);
    if (!doubled.any()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        if (!doubled.removed()[i]) scene.triangles[kept++] = scene.triangles[i];
    scene.triangles.resize(kept);
}

}  // namespace hogel::shading
