// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "hogel/error.h"
#include "hogel/scene.h"
#include "hogel/scene/fit_scale.h"

namespace hogel {

void fit_scene(Scene& scene, const Fit& fit) {
    if (!(fit.width > 0 && fit.height > 0 && fit.fill > 0))
        throw Error(ErrorCode::usage,
                    fmt::format("fit: hologram of {} m x {} m filled to {}; expected sizes above zero", fit.width,
                                fit.height, fit.fill));
    const auto [low, high] = bounds(scene);
    const Vec3 size = high - low;
    const double scale = scene::fit_scale(size, fit);
    if (!std::isfinite(scale))
        throw Error(ErrorCode::bad_input,
                    fmt::format("scene '{}': no width and no height; expected a visible size", scene.name));
    const Vec3 anchor{0.5 * low.x + 0.5 * high.x, 0.5 * low.y + 0.5 * high.y, high.z - fit.front * size.z};
    for (Mesh& mesh : scene.meshes)
        for (Vec3& position : mesh.positions) position = scale * (position - anchor);
    for (Light& light : scene.lights) {
        light.position = scale * (light.position - anchor);
        if (light.kind == Light::Kind::point) light.intensity = static_cast<float>(scale * scale) * light.intensity;
    }
}

void add_default_lights(Scene& scene) {
    Light key;
    key.direction = normalize({0.6, -0.75, -0.6});
    key.intensity = {2.4f, 2.34f, 2.24f};
    Light fill;
    fill.direction = normalize({-0.8, -0.1, -0.5});
    fill.intensity = {0.42f, 0.46f, 0.54f};
    scene.lights.push_back(key);
    scene.lights.push_back(fill);
    scene.ambient += Rgb{0.08f, 0.08f, 0.09f};
}

}  // namespace hogel
