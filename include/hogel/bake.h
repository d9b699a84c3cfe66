// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hogel/export.h"
#include "hogel/progress.h"
#include "hogel/resources.h"
#include "hogel/scene.h"

namespace hogel {

/// Accuracy of bake_scene().
struct BakeOptions {
    std::size_t rays = 256;        ///< rays from each vertex that gather the light reflected by other surfaces
    std::size_t bounces = 5;       ///< number of reflections between surfaces
    std::size_t tessellation = 1;  ///< each triangle is cut into tessellation² triangles
    std::uint64_t seed = 1;        ///< of the random directions of rays
};

/// Computes global illumination: returns the scene with the radiance of every vertex given, including the light that
/// surfaces reflect onto each other. Surfaces are matt. Rays that leave the scene meet its ambient light, which
/// therefore casts shadows. The backs of surfaces are black, since closed bodies never show them.
///
/// Radiosity by gathering (B = B_0 + ρ ∫ B cos θ/π dω solved by iteration): in each of `bounces` rounds every vertex
/// sends rays with a density proportional to the cosine, and collects the radiance of the round before, interpolated
/// between the vertices around each hit. All rounds but the last send an eighth of the rays. Indirect light varies
/// slowly over a surface, so it is computed before the triangles are cut; direct light is computed after.
///
/// The result is the same for any number of threads, to the byte. Cost: vertices × rays × (1 + bounces/8) rays, and one
/// shadow ray per light for each vertex of the cut triangles. Throws what shade_scene() throws, and Error(usage) for
/// zero rays or a tessellation of zero.
HOGEL_API Scene bake_scene(const Scene& scene, const BakeOptions& options = {}, const Progress& progress = {});

/// Resources to light a scene for good and write it as a mesh.
HOGEL_API Plan plan_bake(const Scene& scene, const BakeOptions& options = {});

}  // namespace hogel
