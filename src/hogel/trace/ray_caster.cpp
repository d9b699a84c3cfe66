// SPDX-License-Identifier: Apache-2.0
#include "hogel/trace/ray_caster.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel::trace {
namespace {

constexpr std::size_t packet = 16;  // number of rays in an Embree packet

[[noreturn]] void fail(const char* what) {
    throw Error(ErrorCode::internal, fmt::format("RayCaster: {}; expected Embree to accept the mesh", what));
}

// Progress callback of Embree: returns false to cancel the build after a stop request. Embree calls it from several
// threads, and only the thread that began the build can see the request. It must not throw through Embree.
bool continues_build(void*, double) {
    try {
        core::throw_if_stopped();
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

// Embree works in single precision. So it receives coordinates with the scene's box centred and about 2 wide, and rays
// that begin at the sphere around this box. It only selects the triangle; distance and weights are computed in double
// precision from the caller's ray and triangle.
struct RayCaster::Device {
    TriangleMesh mesh;
    Vec3 center;
    double scale = 1;   ///< Embree's units per metre
    double radius = 0;  ///< of the sphere around the box in metres, with a margin for rounding
    Sides sides = Sides::both;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device() {
        clear();
        if (device) rtcReleaseDevice(device);
    }

    void clear() {
        if (scene) rtcReleaseScene(scene);
        scene = nullptr;
    }
    void set_frame();
    void build();

    /// Ray in Embree's frame: origin, unit direction and length, and its start on the caller's ray.
    struct Segment {
        double start = 0;  ///< in units of the caller's direction
        float x = 0, y = 0, z = 0, dx = 0, dy = 0, dz = 0;
        float length = -1;  ///< negative if the ray misses the sphere
    };
    Segment enter(Vec3 origin, Vec3 direction, double near, double far) const;
    RayHit refine(Vec3 origin, Vec3 direction, double far, std::uint32_t triangle) const;
    bool is_front(Vec3 direction, std::uint32_t triangle) const;
    static void skip_backs(const RTCFilterFunctionNArguments* hits);
    static void skip_holes(const RTCFilterFunctionNArguments* hits);
    static void skip_backs_and_holes(const RTCFilterFunctionNArguments* hits);
};

void RayCaster::Device::set_frame() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t vertex : triangle) {
            const Vec3 p = mesh.positions[vertex];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    center = 0.5 * low + 0.5 * high;
    const Vec3 size = high - low;
    const double widest = std::max({size.x, size.y, size.z});
    scale = widest > 0 ? 2 / widest : 1;
    radius = 0.5 * length(size) * (1 + 1e-5) + 1e-5 / scale;
}

// Embree is not built for the thread sanitizer, which would report the synchronisation of its threads as data races.
#ifdef __SANITIZE_THREAD__
constexpr const char* device_options = "threads=1";
#else
constexpr const char* device_options = nullptr;
#endif

void RayCaster::Device::build() {
    const auto clear_and_fail = [this](const char* what) {
        clear();
        fail(what);
    };
    if (!device) device = rtcNewDevice(device_options);
    if (!device) clear_and_fail("no Embree device");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (!vertices || !indices) {
        rtcReleaseGeometry(geometry);
        clear_and_fail("out of memory");
    }
    for (const Vec3& position : mesh.positions) {
        const Vec3 p = scale * (position - center);
        *vertices++ = static_cast<float>(p.x);
        *vertices++ = static_cast<float>(p.y);
        *vertices++ = static_cast<float>(p.z);
    }
    for (const auto& triangle : mesh.triangles) indices = std::copy(triangle.begin(), triangle.end(), indices);
    rtcSetGeometryUserData(geometry, this);
    if (sides == Sides::fronts)
        rtcSetGeometryIntersectFilterFunction(geometry, mesh.is_solid ? skip_backs_and_holes : skip_backs);
    else if (mesh.is_solid)
        rtcSetGeometryIntersectFilterFunction(geometry, skip_holes);
    if (mesh.is_solid) rtcSetGeometryOccludedFilterFunction(geometry, skip_holes);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneProgressMonitorFunction(scene, continues_build, nullptr);
    rtcCommitScene(scene);
    const bool is_built = rtcGetDeviceError(device) == RTC_ERROR_NONE;
    if (!is_built) core::throw_if_stopped();
    if (!is_built) clear_and_fail("Embree reports an error");
}

bool RayCaster::Device::is_front(Vec3 direction, std::uint32_t index) const {
    const auto& [a, b, c] = mesh.triangles[index];
    const std::vector<Vec3>& p = mesh.positions;
    return dot(cross(p[b] - p[a], p[c] - p[a]), direction) < 0;
}

// Rejects hits on the backs of triangles, so that these rays continue.
void RayCaster::Device::skip_backs(const RTCFilterFunctionNArguments* hits) {
    const auto& device = *static_cast<const Device*>(hits->geometryUserPtr);
    for (unsigned i = 0; i < hits->N; ++i) {
        if (hits->valid[i] == 0) continue;
        const Vec3 direction{RTCRayN_dir_x(hits->ray, hits->N, i), RTCRayN_dir_y(hits->ray, hits->N, i),
                             RTCRayN_dir_z(hits->ray, hits->N, i)};
        if (!device.is_front(direction, RTCHitN_primID(hits->hit, hits->N, i))) hits->valid[i] = 0;
    }
}

// Rejects hits in the holes of triangles.
void RayCaster::Device::skip_holes(const RTCFilterFunctionNArguments* hits) {
    const auto& device = *static_cast<const Device*>(hits->geometryUserPtr);
    for (unsigned i = 0; i < hits->N; ++i)
        if (hits->valid[i] != 0 &&
            !device.mesh.is_solid(RTCHitN_primID(hits->hit, hits->N, i), RTCHitN_u(hits->hit, hits->N, i),
                                  RTCHitN_v(hits->hit, hits->N, i)))
            hits->valid[i] = 0;
}

void RayCaster::Device::skip_backs_and_holes(const RTCFilterFunctionNArguments* hits) {
    skip_backs(hits);
    skip_holes(hits);
}

RayCaster::Device::Segment RayCaster::Device::enter(Vec3 origin, Vec3 direction, double near, double far) const {
    Segment segment;
    const double speed = length(direction);
    const Vec3 unit = direction / speed;
    const Vec3 from_center = origin - center;
    const double middle = -dot(from_center, unit);  // middle of the chord, in metres along the ray
    const double half_squared = radius * radius - dot(from_center, from_center) + middle * middle;
    if (!(half_squared >= 0)) return segment;
    const double half = std::sqrt(half_squared);
    const double begin = std::max(near * speed, middle - half);
    const double end = std::min(far * speed, middle + half);
    if (!(begin <= end)) return segment;
    const Vec3 p = scale * (from_center + begin * unit);
    segment = {begin / speed,
               static_cast<float>(p.x),
               static_cast<float>(p.y),
               static_cast<float>(p.z),
               static_cast<float>(unit.x),
               static_cast<float>(unit.y),
               static_cast<float>(unit.z),
               static_cast<float>(scale * (end - begin))};
    return segment;
}

/// Source: Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
RayHit RayCaster::Device::refine(Vec3 origin, Vec3 direction, double far, std::uint32_t index) const {
    const auto& triangle = mesh.triangles[index];
    const Vec3 a = mesh.positions[triangle[0]];
    const Vec3 ab = mesh.positions[triangle[1]] - a, ac = mesh.positions[triangle[2]] - a;
    const Vec3 to_origin = origin - a;
    const Vec3 p = cross(direction, ac), q = cross(to_origin, ab);
    const double inverse = 1 / dot(ab, p);
    double b1 = dot(to_origin, p) * inverse, b2 = dot(direction, q) * inverse;
    double distance = dot(ac, q) * inverse;
    if (!(b1 >= 0 && b2 >= 0 && b1 + b2 <= 1)) {
        // The exact hit may be just outside the triangle although the single-precision hit is on its edge. For a
        // triangle seen edge-on it may even be far away along the ray. So the nearest point of the triangle is used.
        b1 = b1 > 0 ? std::min(b1, 1.0) : 0;
        b2 = b2 > 0 ? std::min(b2, 1.0) : 0;
        const double sum = std::max(b1 + b2, 1.0);
        b1 /= sum;
        b2 /= sum;
        distance = dot(a + b1 * ab + b2 * ac - origin, direction) / dot(direction, direction);
    }
    return {std::clamp(distance, 0.0, far), index, static_cast<float>(b1), static_cast<float>(b2)};
}

RayCaster::RayCaster() : device_(std::make_unique<Device>()) {}

RayCaster::RayCaster(std::span<const Vec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
                     Sides sides)
    : RayCaster() {
    set({{positions.begin(), positions.end()}, {triangles.begin(), triangles.end()}, {}}, sides);
}

void RayCaster::set(TriangleMesh mesh, Sides sides) {
    device_->clear();
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t vertex : triangle)
            if (vertex >= mesh.positions.size())
                throw Error(ErrorCode::bad_input, fmt::format("triangle: vertex index {}; expected less than {}",
                                                              vertex, mesh.positions.size()));
    device_->mesh = std::move(mesh);
    device_->sides = sides;
    if (device_->mesh.triangles.empty()) return;
    device_->set_frame();
    device_->build();
}

TriangleMesh RayCaster::release() {
    device_->clear();
    return std::move(device_->mesh);
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

RayHit RayCaster::closest(Vec3 origin, Vec3 direction, double far) const {
    if (!device_->scene) return {};
    const auto segment = device_->enter(origin, direction, 0, far);
    if (segment.length < 0) return {};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray = {segment.x, segment.y, segment.z, 0, segment.dx, segment.dy, segment.dz, 0, segment.length, ~0u, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(device_->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return device_->refine(origin, direction, far, ray.hit.primID);
}

void RayCaster::closest(std::span<const Vec3> origins, std::span<const Vec3> directions, double far,
                        std::span<RayHit> hits) const {
    if (!device_->scene) {
        std::fill(hits.begin(), hits.end(), RayHit{});
        return;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < hits.size(); first += packet) {
        const std::size_t n = std::min(packet, hits.size() - first);
        alignas(64) RTCRayHit16 rays;
        alignas(64) std::array<int, packet> valid{};
        for (std::size_t i = 0; i < packet; ++i) {
            const auto segment =
                i < n ? device_->enter(origins[first + i], directions[first + i], 0, far) : Device::Segment{};
            valid[i] = segment.length >= 0 ? -1 : 0;
            rays.ray.org_x[i] = segment.x, rays.ray.org_y[i] = segment.y, rays.ray.org_z[i] = segment.z;
            rays.ray.dir_x[i] = segment.dx, rays.ray.dir_y[i] = segment.dy, rays.ray.dir_z[i] = segment.dz;
            rays.ray.tnear[i] = 0, rays.ray.tfar[i] = segment.length, rays.ray.time[i] = 0;
            rays.ray.mask[i] = ~0u, rays.ray.id[i] = 0, rays.ray.flags[i] = 0;
            rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid.data(), device_->scene, &context, &rays);
        for (std::size_t i = 0; i < n; ++i)
            hits[first + i] = valid[i] && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID
                                  ? device_->refine(origins[first + i], directions[first + i], far, rays.hit.primID[i])
                                  : RayHit{};
    }
}

bool RayCaster::occluded(Vec3 origin, Vec3 direction, double near, double far) const {
    if (!device_->scene) return false;
    const auto segment = device_->enter(origin, direction, near, far);
    if (segment.length < 0) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{segment.x, segment.y, segment.z, 0, segment.dx, segment.dy, segment.dz, 0, segment.length, ~0u, 0, 0};
    rtcOccluded1(device_->scene, &context, &ray);
    return ray.tfar < 0;
}

void RayCaster::occluded(Vec3 origin, std::span<const Vec3> directions, double near, double far,
                         std::span<bool> hidden) const {
    std::ranges::fill(hidden, false);
    if (!device_->scene) return;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    // A ray that starts inside the sphere around the scene leaves it within the sphere's diameter.
    const Vec3 from_center = origin - device_->center;
    const double end = std::min(far, 2 * device_->radius), scale = device_->scale;
    if (dot(from_center, from_center) > device_->radius * device_->radius || !(near < end)) {
        for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] = occluded(origin, directions[i], near, far);
        return;
    }
    const Vec3 start = scale * from_center;
    for (std::size_t first = 0; first < hidden.size(); first += packet) {
        const std::size_t n = std::min(packet, hidden.size() - first);
        alignas(64) RTCRay16 rays{};
        alignas(64) std::array<int, packet> valid{};
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 direction = directions[first + i], begin = start + scale * near * direction;
            rays.org_x[i] = static_cast<float>(begin.x);
            rays.org_y[i] = static_cast<float>(begin.y);
            rays.org_z[i] = static_cast<float>(begin.z);
            rays.dir_x[i] = static_cast<float>(direction.x);
            rays.dir_y[i] = static_cast<float>(direction.y);
            rays.dir_z[i] = static_cast<float>(direction.z);
            rays.tfar[i] = static_cast<float>(scale * (end - near));
            rays.mask[i] = ~0u;
            valid[i] = -1;
        }
        rtcOccluded16(valid.data(), device_->scene, &context, &rays);
        for (std::size_t i = 0; i < n; ++i) hidden[first + i] = rays.tfar[i] < 0;
    }
}

}  // namespace hogel::trace
