#pragma once

#include <span>
#include <string_view>

#include "hogel/core/progress.h"
#include "hogel/shading/shaded_scene.h"

namespace hogel {

/// Where light is worked out. The models of [K] 5.8.
enum class ShadingModel {
    vertex,    ///< at the vertices, with shadow rays, and interpolated; matt
    direct,    ///< at each sample, with shadow maps, and the glossy lobe
    shadowed,  ///< at the vertices without shadows and interpolated; shadow maps at each sample; matt
    given,     ///< each vertex brings its radiance
};

struct ShadingInfo {
    ShadingModel model;
    std::string_view name;
    std::string_view description;  ///< one line
};

/// All models by name, in the order in which to show them.
std::span<const ShadingInfo> shading_models();

/// Throws Error(usage) for an unknown name, listing the known ones.
ShadingModel shading_model(std::string_view name);

struct ShadingOptions {
    ShadingModel model = ShadingModel::vertex;
    std::size_t shadow_map = 512;    ///< texels along a side of a shadow map (see ShadowMap)
    double most_shadow_bytes = 8e9;  ///< of all shadow maps together
    bool filter_textures = true;     ///< average textures over what a sample covers
};

/// How much memory the shadow maps of a scene take: none where the model has no shadow maps.
double shadow_map_bytes(const Scene& scene, const ShadingOptions& options);

/// Makes a scene ready to be rendered. Meshes with given radiance show that in every model. Throws what
/// validate(Scene) throws; Error(bad_input) for a mesh without normals where there are lights, and, for `given`, for
/// one without radiance; Error(usage) where the shadow maps would take more memory than allowed.
ShadedScene shade(const Scene& scene, const ShadingOptions& options, const Progress& progress = {});

/// Lights a scene at its vertices (Gouraud): radiance = emission + colour · (ambient + Σ E · max(0, n·l)/π) over the
/// lights that the vertex sees, E = intensity for a directional light and intensity/r² for a point light. Shadow rays
/// start a ten-thousandth of the scene's diagonal above the surface. Textures are point sampled. Cost: vertices ×
/// lights rays.
ShadedScene shade_vertices(const Scene& scene);

}  // namespace hogel
