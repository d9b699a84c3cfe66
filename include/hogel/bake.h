// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/progress.h"
#include "hogel/scene.h"

namespace hogel {

struct BakeOptions {
    std::size_t rays = 256;        ///< from each vertex, for the light that other surfaces reflect
    std::size_t bounces = 5;       ///< how often light is reflected between surfaces
    std::size_t tessellation = 1;  ///< every triangle is cut into the square of this many
    std::uint64_t seed = 1;
};

/// Lights a scene for good: the same scene with the radiance of every vertex given, light that surfaces reflect onto
/// each other included. Surfaces are matt; rays that leave the scene meet its ambient light (which here has shadows);
/// the backs of surfaces are black, as closed bodies never show them.
///
/// Radiosity by gathering (the solution of B = B_0 + ρ ∫ B cos θ/π dω by iteration): in each of `bounces` rounds every
/// vertex sends rays, more where the cosine is larger, and collects what the vertices around their hits showed in the
/// round before; all rounds but the last get by with an eighth of the rays. Indirect light changes slowly over a
/// surface, so it is worked out before the triangles are cut, and direct light after.
///
/// The same bytes for any number of threads. Cost: vertices × rays × (1 + bounces/8) rays, and a shadow ray a light for
/// each vertex of the cut triangles. Throws what shade_scene() throws, and Error(usage) for zero rays or parts.
Scene bake_scene(const Scene& scene, const BakeOptions& options, const Progress& progress = {});

}  // namespace hogel
