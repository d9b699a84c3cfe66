// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/inside_out.h"

#include <cmath>
#include <utility>

namespace hogel::scene::mesh_files {

bool is_body(Vec3 open, double area, double volume) {
    constexpr double max_open = 0.1;  // by the area; an open box has a fifth of its area left
    // By the area to 3/2: 0.094 for a sphere, 0.007 for a plate fifty times as wide as thick.
    constexpr double min_volume = 0.003;
    return std::abs(volume) > min_volume * std::pow(area, 1.5) && length(open) <= max_open * area;
}

Sides turn_inside_out(Mesh& mesh) {
    if (mesh.triangles.empty()) return {};
    const Vec3 origin = mesh.positions[mesh.triangles[0][0]];
    Vec3 open{};
    double area = 0, volume = 0, agreement = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 p = mesh.positions[a] - origin, q = mesh.positions[b] - origin, r = mesh.positions[c] - origin;
        const Vec3 front = 0.5 * cross(q - p, r - p);
        open += front;
        area += length(front);
        volume += dot(p, cross(q, r)) / 6;
        if (!mesh.normals.empty()) agreement += dot(front, mesh.normals[a] + mesh.normals[b] + mesh.normals[c]);
    }
    if (!is_body(open, area, volume)) return {};
    const bool inwards = volume < 0, normals_inwards = inwards ? agreement > 0 : agreement < 0;
    if (inwards)
        for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
    if (normals_inwards)
        for (Vec3& normal : mesh.normals) normal = -normal;
    return {true, inwards || normals_inwards};
}

}  // namespace hogel::scene::mesh_files
