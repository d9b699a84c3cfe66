// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hogel/geometry.h"

namespace hogel::trace {

/// Where a ray meets a triangle first.
struct RayHit {
    static constexpr std::uint32_t miss = ~std::uint32_t{0};

    double distance = 0;            ///< in units of the ray's direction
    std::uint32_t triangle = miss;  ///< index into the triangles that the caster was built from
    float b1 = 0, b2 = 0;           ///< barycentric weights of the second and third vertex
};

/// Which sides of a triangle are hit: a ray meets the front if it sees the corners go round counterclockwise.
enum class Sides { both, fronts };

/// Rays against triangles, by Embree. Thread-safe after construction.
class RayCaster {
  public:
    /// @param sides  that `closest` hits; `occluded` always both
    RayCaster(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
              Sides sides = Sides::both);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// The first hit along origin + distance · direction, distance in [0, far].
    RayHit closest(Vec3 origin, Vec3 direction, double far) const;
    /// The same for many rays that start and point close to each other: `hits` gets one hit a ray.
    void closest(std::span<const Vec3> origins, std::span<const Vec3> directions, double far,
                 std::span<RayHit> hits) const;
    /// Whether anything lies on origin + distance · direction for distance in [near, far].
    bool occluded(Vec3 origin, Vec3 direction, double near, double far) const;
    /// The same for many rays that start at one place, with directions of unit length: `hidden` gets one answer a ray.
    void occluded(Vec3 origin, std::span<const Vec3> directions, double near, double far, std::span<bool> hidden) const;

  private:
    struct Device;
    std::unique_ptr<Device> device_;
};

}  // namespace hogel::trace
