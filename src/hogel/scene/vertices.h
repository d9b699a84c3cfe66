// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/scene.h"

namespace hogel::scene {

/// Appends a copy of a vertex with all its attributes, and returns its index.
inline std::uint32_t add_copy_of_vertex(Mesh& mesh, std::uint32_t vertex) {
    const auto append = [vertex](auto& values) {
        if (values.empty()) return;
        const auto value = values[vertex];
        values.push_back(value);
    };
    const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
    append(mesh.positions);
    append(mesh.normals);
    append(mesh.colors);
    append(mesh.radiance);
    append(mesh.alphas);
    for (auto* coordinates :
         {&mesh.texture_coordinates, &mesh.emission_coordinates, &mesh.metallic_roughness_coordinates,
          &mesh.normal_coordinates, &mesh.occlusion_coordinates})
        append(*coordinates);
    return copy;
}

}  // namespace hogel::scene
