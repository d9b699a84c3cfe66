// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/export.h"
#include "hogel/progress.h"
#include "hogel/scene.h"

namespace hogel {

/// How finely bake_scene() works.
struct BakeOptions {
    std::size_t rays = 256;        ///< sent from each vertex, for the light that other surfaces reflect
    std::size_t bounces = 5;       ///< number of reflections between surfaces
    std::size_t tessellation = 1;  ///< every triangle is cut into the square of this number
    std::uint64_t seed = 1;        ///< of the directions of rays
};

/// A global solution of a scene's light: the same scene with the radiance of every vertex given, including the light
/// that surfaces reflect onto each other. Surfaces are matt; rays that leave the scene meet its ambient light (which
/// here has shadows); the backs of surfaces are black, since closed bodies never show them.
///
/// Radiosity by gathering (B = B_0 + ρ ∫ B cos θ/π dω solved by iteration): in each of `bounces` rounds every vertex
/// sends rays with a density proportional to the cosine, and collects the radiance of the round before, interpolated
/// between the vertices around each hit. All rounds but the last send an eighth of the rays. Indirect light varies
/// slowly over a surface, so it is computed before the triangles are cut, and direct light after.
///
/// The same bytes for any number of threads. Cost: vertices × rays × (1 + bounces/8) rays, and a shadow ray a light for
/// each vertex of the cut triangles. Throws what shade_scene() throws, and Error(usage) for zero rays or a tessellation
/// of zero.
HOGEL_API Scene bake_scene(const Scene& scene, const BakeOptions& options = {}, const Progress& progress = {});

}  // namespace hogel
