// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/error.h"

namespace hogel {
namespace {

[[noreturn]] void reject(const std::string& mesh, const std::string& what) {
    throw Error(ErrorCode::bad_input, fmt::format("mesh '{}': {}", mesh, what));
}

bool finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
bool finite(Rgb c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }
bool finite(float value) { return std::isfinite(value); }
bool finite(TextureCoordinate t) { return std::isfinite(t.u) && std::isfinite(t.v); }

template <class T>
void validate_attribute(const Mesh& mesh, const std::vector<T>& values, const char* name, bool may_be_absent) {
    if (values.size() != mesh.positions.size() && !(may_be_absent && values.empty()))
        reject(mesh.name, fmt::format("{} {}; expected {}, one a vertex", values.size(), name, mesh.positions.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!finite(values[i])) reject(mesh.name, fmt::format("{} of vertex {} not finite; expected numbers", name, i));
}

}  // namespace

Bounds bounds(const Scene& scene) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Bounds box{{inf, inf, inf}, {-inf, -inf, -inf}};
    for (const Mesh& mesh : scene.meshes)
        for (const auto& triangle : mesh.triangles)
            for (std::uint32_t vertex : triangle) {
                const Vec3 p = mesh.positions[vertex];
                box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
                box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
            }
    if (!(box.low.x <= box.high.x))
        throw Error(ErrorCode::bad_input, fmt::format("scene '{}': no triangles; expected at least one", scene.name));
    return box;
}

std::size_t triangle_count(const Scene& scene) {
    std::size_t n = 0;
    for (const Mesh& mesh : scene.meshes) n += mesh.triangles.size();
    return n;
}

void validate(const Scene& scene) {
    std::size_t vertices = 0;
    for (const Mesh& mesh : scene.meshes) {
        vertices += mesh.positions.size();
        validate_attribute(mesh, mesh.positions, "positions", false);
        validate_attribute(mesh, mesh.normals, "normals", true);
        validate_attribute(mesh, mesh.colors, "colors", true);
        validate_attribute(mesh, mesh.radiance, "radiances", true);
        validate_attribute(mesh, mesh.alphas, "alphas", true);
        validate_attribute(mesh, mesh.texture_coordinates, "texture coordinates", true);
        validate_attribute(mesh, mesh.emission_coordinates, "coordinates of the emission texture", true);
        validate_attribute(mesh, mesh.metallic_roughness_coordinates, "coordinates of the metallic-roughness texture",
                           true);
        validate_attribute(mesh, mesh.normal_coordinates, "coordinates of the normal texture", true);
        validate_attribute(mesh, mesh.occlusion_coordinates, "coordinates of the occlusion texture", true);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (std::uint32_t vertex : mesh.triangles[i])
                if (vertex >= mesh.positions.size())
                    reject(mesh.name, fmt::format("triangle {} has vertex index {}; expected less than {}", i, vertex,
                                                  mesh.positions.size()));
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::bad_input,
                    fmt::format("scene '{}': {} vertices; expected less than 2^32", scene.name, vertices));
    if (triangle_count(scene) == 0)
        throw Error(ErrorCode::bad_input, fmt::format("scene '{}': no triangles; expected at least one", scene.name));
}

}  // namespace hogel
