// SPDX-License-Identifier: Apache-2.0
// Replaces ray_caster.cpp in a build without Embree. A caster can be created, but accepts no triangles.
#include "hogel/core/part.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::trace {
namespace {

[[noreturn]] void refuse() { core::refuse_without("Embree", "casting rays"); }

}  // namespace

struct RayCaster::Device {};

RayCaster::RayCaster() = default;
RayCaster::RayCaster(std::span<const Vec3>, std::span<const std::array<std::uint32_t, 3>>, Sides) { refuse(); }
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

void RayCaster::set(TriangleMesh, Sides) { refuse(); }
TriangleMesh RayCaster::release() { return {}; }

RayHit RayCaster::closest(Vec3, Vec3, double) const { refuse(); }
void RayCaster::closest(std::span<const Vec3>, std::span<const Vec3>, double, std::span<RayHit>) const { refuse(); }
bool RayCaster::occluded(Vec3, Vec3, double, double) const { refuse(); }
void RayCaster::occluded(Vec3, std::span<const Vec3>, double, double, std::span<bool>) const { refuse(); }

}  // namespace hogel::trace
