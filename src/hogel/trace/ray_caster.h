// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::trace {

/// First point at which a ray meets a triangle.
struct RayHit {
    static constexpr std::uint32_t miss = ~std::uint32_t{0};

    double distance = 0;            ///< in units of the ray's direction
    std::uint32_t triangle = miss;  ///< index into the caster's triangles
    float b1 = 0, b2 = 0;           ///< barycentric weights of the second and third vertex
};

/// Sides of triangles that can be hit. A ray meets the front if it sees the corners in counterclockwise order.
enum class Sides { both, fronts };

struct TriangleMesh {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of positions
    /// Tells whether a triangle is opaque at the point with these barycentric weights of its second and third vertex;
    /// rays pass through other points. Empty if all triangles are opaque everywhere. Called from several threads at
    /// once.
    std::function<bool(std::uint32_t triangle, float b1, float b2)> is_solid = {};
};

/// Intersects rays with triangles, by Embree. Rays may be cast from several threads at once, but not during set().
class RayCaster {
  public:
    /// Makes a caster without triangles.
    RayCaster();
    /// @param sides  sides that closest() hits; occluded() always hits both
    RayCaster(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
              Sides sides = Sides::both);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// Replaces the triangles. Throws Error(bad_input) for an index without a position.
    void set(TriangleMesh mesh, Sides sides = Sides::both);
    /// Moves the triangles out for reusing their memory. No ray hits anything until the next set().
    TriangleMesh release();

    /// Returns the first hit along origin + distance · direction, distance in [0, far].
    RayHit closest(Vec3 origin, Vec3 direction, double far) const;
    /// Computes the first hits of many rays with similar origins and directions; `hits` receives one hit per ray.
    void closest(std::span<const Vec3> origins, std::span<const Vec3> directions, double far,
                 std::span<RayHit> hits) const;
    /// Returns whether any triangle is on origin + distance · direction for distance in [near, far].
    bool occluded(Vec3 origin, Vec3 direction, double near, double far) const;
    /// Tests many rays from one origin with directions of unit length; `hidden` receives one result per ray.
    void occluded(Vec3 origin, std::span<const Vec3> directions, double near, double far, std::span<bool> hidden) const;

  private:
    struct Device;
    std::unique_ptr<Device> device_;
};

}  // namespace hogel::trace
