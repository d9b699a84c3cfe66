// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/error.h"
#include "hogel/shading/lighting.h"

namespace hogel::shading {
namespace {

void require_given_radiance(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (mesh.radiance.empty() && !mesh.triangles.empty())
            throw Error(ErrorCode::bad_input,
                        fmt::format("mesh '{}': brings no radiance; expected one a vertex for the "
                                    "shading model 'given', as a baked scene has",
                                    mesh.name));
}

}  // namespace

ShadingInfo given_shading() {
    return {.name = "given",
            .text = "the radiance that each vertex brings, as baked scenes do",
            .make = [](const Scene& scene, const ShadingOptions&, ShadedScene&, const Progress&) {
                require_given_radiance(scene);
                return nullptr;
            }};
}

}  // namespace hogel::shading
