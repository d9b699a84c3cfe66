// SPDX-License-Identifier: Apache-2.0
// Alignment of the hologram with a camera of the scene file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "hogel/error.h"
#include "hogel/scene.h"

namespace hogel {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Camera frame: x right, y up, z backwards.
struct CameraFrame {
    Vec3 origin, right, up, back;

    explicit CameraFrame(const SceneCamera& camera)
        : origin(camera.position), right(camera.right), up(camera.up), back(cross(camera.right, camera.up)) {}
    Vec3 turned(Vec3 v) const { return {dot(v, right), dot(v, up), dot(v, back)}; }
};

/// Clips a convex polygon to the half-space side >= 0.
template <class Side>
std::vector<Vec3> cut(const std::vector<Vec3>& polygon, const Side& side) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double sa = side(a), sb = side(b);
        if (sa >= 0) kept.push_back(a);
        if ((sa >= 0) != (sb >= 0)) kept.push_back(a + sa / (sa - sb) * (b - a));
    }
    return kept;
}

struct Depths {
    double nearest = infinite, farthest = -infinite;
};

/// Returns the depth range inside the picture, including hidden parts, of a scene in the camera frame.
/// @param aspect  width over height of the picture
Depths depths_in_picture(const Scene& scene, const SceneCamera& camera, double aspect) {
    const double slope = std::tan(camera.angle / 2), half = camera.height / 2;  // one of the two is zero
    Depths depths;
    for (const Mesh& mesh : scene.meshes)
        for (const auto& triangle : mesh.triangles) {
            std::vector<Vec3> clipped;
            for (const std::uint32_t vertex : triangle) clipped.push_back(mesh.positions[vertex]);
            for (const double sign : {-1.0, 1.0}) {
                clipped = cut(clipped, [&](Vec3 p) { return half - slope * p.z + sign * p.y; });
                clipped = cut(clipped, [&](Vec3 p) { return aspect * (half - slope * p.z) + sign * p.x; });
            }
            for (const Vec3 p : clipped) {
                depths.nearest = std::min(depths.nearest, -p.z);
                depths.farthest = std::max(depths.farthest, -p.z);
            }
        }
    return depths;
}

/// Clips a mesh at a depth in front of the camera.
class Cutter {
  public:
    Cutter(Mesh& mesh, double nearest) : mesh_(mesh), nearest_(nearest) {}

    void run() {
        std::vector<std::array<std::uint32_t, 3>> kept;
        for (const auto& triangle : mesh_.triangles) {
            std::vector<std::uint32_t> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
                const double sa = beyond(a), sb = beyond(b);
                if (sa >= 0) corners.push_back(a);
                if ((sa >= 0) != (sb >= 0)) corners.push_back(between(a, b, sa / (sa - sb)));
            }
            for (std::size_t i = 2; i < corners.size(); ++i) kept.push_back({corners[0], corners[i - 1], corners[i]});
        }
        mesh_.triangles = std::move(kept);
    }

  private:
    double beyond(std::uint32_t vertex) const { return -mesh_.positions[vertex].z - nearest_; }

    std::uint32_t between(std::uint32_t a, std::uint32_t b, double part) {
        const auto weight = static_cast<float>(part);
        const auto add = [&](auto& values, const auto& mixed) {
            if (!values.empty()) values.push_back(mixed(values[a], values[b]));
        };
        const auto floats = [&](const auto& p, const auto& q) { return (1 - weight) * p + weight * q; };
        const auto vectors = [&](Vec3 p, Vec3 q) { return p + part * (q - p); };
        add(mesh_.positions, vectors);
        add(mesh_.normals, [&](Vec3 p, Vec3 q) {
            const Vec3 sum = vectors(p, q);
            return length(sum) > 0 ? normalize(sum) : p;
        });
        add(mesh_.colors, floats);
        add(mesh_.radiance, floats);
        add(mesh_.alphas, floats);
        for (auto* coordinates :
             {&mesh_.texture_coordinates, &mesh_.emission_coordinates, &mesh_.metallic_roughness_coordinates,
              &mesh_.normal_coordinates, &mesh_.occlusion_coordinates})
            add(*coordinates, [&](TextureCoordinate p, TextureCoordinate q) {
                return TextureCoordinate{floats(p.u, q.u), floats(p.v, q.v)};
            });
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    Mesh& mesh_;
    double nearest_;
};

void move_into(Scene& scene, const CameraFrame& view) {
    for (Mesh& mesh : scene.meshes) {
        for (Vec3& position : mesh.positions) position = view.turned(position - view.origin);
        for (Vec3& normal : mesh.normals) normal = view.turned(normal);
    }
    for (Light& light : scene.lights) {
        light.position = view.turned(light.position - view.origin);
        light.direction = view.turned(light.direction);
    }
}

/// Returns the depth of the plane that divides two depths by disparity, or by depth for parallel rays.
double plane_depth(const Depths& depths, double front, bool parallel) {
    if (parallel) return depths.nearest + front * (depths.farthest - depths.nearest);
    const double disparity = (1 - front) / depths.nearest + front / depths.farthest;
    return 1 / std::max(disparity, 0.1 / depths.farthest);  // with everything and more in front: ten times as far
}

}  // namespace

const SceneCamera& find_camera(const Scene& scene, const std::string& name) {
    for (const SceneCamera& camera : scene.cameras)
        if (!name.empty() && camera.name == name) return camera;
    std::size_t number = 0;
    const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (status == std::errc{} && end == name.data() + name.size() && number >= 1 && number <= scene.cameras.size())
        return scene.cameras[number - 1];
    std::string known;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        known += fmt::format("{}{}{}", i == 0 ? "" : ", ", i + 1,
                             scene.cameras[i].name.empty() ? "" : fmt::format(" '{}'", scene.cameras[i].name));
    throw Error(ErrorCode::usage, "scene_camera",
                scene.cameras.empty() ? fmt::format("camera '{}': the scene '{}' has no cameras", name, scene.name)
                                      : fmt::format("camera '{}': unknown; expected one of {}", name, known));
}

double frame_scene(Scene& scene, const SceneCamera& camera, const Fit& fit) {
    if (!(fit.width > 0 && fit.height > 0))
        throw Error(ErrorCode::usage,
                    fmt::format("camera: hologram of {} m x {} m; expected sizes above zero", fit.width, fit.height));
    const bool parallel = camera.angle == 0;
    const SceneCamera used = camera;  // copy, because it may be one of the scene's
    move_into(scene, CameraFrame(used));
    const double least = std::max(used.nearest, 1e-6 * length(bounds(scene).high - bounds(scene).low));
    for (Mesh& mesh : scene.meshes) Cutter(mesh, least).run();
    std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.triangles.empty(); });
    const Depths depths = depths_in_picture(scene, used, fit.width / fit.height);
    if (!(depths.nearest <= depths.farthest))
        throw Error(ErrorCode::bad_input, fmt::format("scene '{}': its camera '{}' sees nothing; expected a camera "
                                                      "with surfaces in its view",
                                                      scene.name, used.name));
    const double plane = plane_depth(depths, fit.front, parallel);
    const double scale = fit.height / (parallel ? used.height : 2 * plane * std::tan(used.angle / 2));
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position = scale * (position + Vec3{0, 0, plane});
    for (Light& light : scene.lights) {
        light.position = scale * (light.position + Vec3{0, 0, plane});
        if (light.kind == Light::Kind::point) light.intensity = static_cast<float>(scale * scale) * light.intensity;
    }
    scene.cameras.clear();
    return parallel ? infinite : scale * plane;
}

}  // namespace hogel
