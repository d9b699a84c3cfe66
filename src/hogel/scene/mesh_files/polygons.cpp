// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/polygons.h"

#include <fmt/format.h>

#include <vector>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/triangulate.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::size_t max_corners = 4096;  // triangulation takes quadratic time

bool is_flat(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Vec3 a = mesh.positions[t[0]];
    return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a) == Vec3{};
}

}  // namespace

void add_polygon(std::span<const std::uint32_t> corners, bool mirrored, const std::string& file, Mesh& mesh) {
    for (const std::uint32_t index : corners)
        if (index >= mesh.positions.size())
            reject_file(file, fmt::format("mesh '{}': vertex index {}", mesh.name, index),
                        fmt::format("less than {}", mesh.positions.size()));
    if (corners.size() > max_corners)
        reject_file(file, fmt::format("a face with {} corners", corners.size()),
                    fmt::format("at most {}", max_corners));
    if (corners.size() < 3) return;
    const auto add = [&](std::array<std::uint32_t, 3> triangle) {
        if (mirrored) std::swap(triangle[1], triangle[2]);
        if (!is_flat(mesh, triangle)) mesh.triangles.push_back(triangle);
    };
    if (corners.size() == 3) return add({corners[0], corners[1], corners[2]});
    std::vector<Vec3> polygon;
    for (const std::uint32_t index : corners) polygon.push_back(mesh.positions[index]);
    for (const auto& [a, b, c] : scene::triangulate(polygon)) add({corners[a], corners[b], corners[c]});
}

}  // namespace hogel::scene::mesh_files
