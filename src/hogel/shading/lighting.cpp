// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/lighting.h"

#include <algorithm>

#include "hogel/scene.h"
#include "hogel/shading/illumination.h"

namespace hogel::shading {

double bytes_of_shadow_maps(const Scene& scene, const ShadingOptions& options) {
    double sum = 0;
    for (const Light& light : scene.lights) sum += ShadowMap::bytes(light, options.shadow_map);
    return sum;
}

double ray_offset(const Scene& scene) {
    const Bounds box = bounds(scene);
    return 1e-4 * length(box.high - box.low);
}

double ray_offset(const Mesh& mesh, double scene_offset) {
    if (mesh.name != points_name || mesh.triangles.empty()) return scene_offset;
    // A disc is a fan of triangles. The last side of each is a side of the hexagon, as long as its radius.
    double sum = 0;
    for (const auto& triangle : mesh.triangles)
        sum += length(mesh.positions[triangle[2]] - mesh.positions[triangle[1]]);
    return std::max(scene_offset, sum / static_cast<double>(mesh.triangles.size()));
}

Rgb irradiance(const Scene& scene, const trace::RayCaster& caster, double offset, Vec3 point, Vec3 normal) {
    Rgb sum{0, 0, 0};
    for (const Light& light : scene.lights) {
        const Illumination illumination = illuminate(light, point);
        const double cosine = dot(normal, illumination.to_light);
        if (!(cosine > 0)) continue;
        if (light.casts_shadows &&
            caster.occluded(point + offset * normal, illumination.to_light, 0, illumination.distance))
            continue;
        sum += static_cast<float>(illumination.falloff * cosine) * light.intensity;
    }
    return sum;
}

}  // namespace hogel::shading
