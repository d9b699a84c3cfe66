// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hogel/shading/gloss.h"

namespace hogel::shading {

LampTable::LampTable(std::span<const Light> lights) {
    const std::size_t size = (lights.size() + block - 1) / block * block;
    for (Numbers* numbers : {&x, &y, &z, &is_point, &r, &g, &b}) numbers->resize(size);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        const bool distant = light.kind == Light::Kind::directional;
        const Vec3 position = distant ? -normalize(light.direction) : light.position;
        x[i] = static_cast<float>(position.x);
        y[i] = static_cast<float>(position.y);
        z[i] = static_cast<float>(position.z);
        is_point[i] = distant ? 0.0f : 1.0f;
        r[i] = light.intensity.r;
        g[i] = light.intensity.g;
        b[i] = light.intensity.b;
    }
}

GlossyFloats::GlossyFloats(const GlossyPoint& point)
    : px(static_cast<float>(point.position.x)),
      py(static_cast<float>(point.position.y)),
      pz(static_cast<float>(point.position.z)),
      nx(static_cast<float>(point.normal.x)),
      ny(static_cast<float>(point.normal.y)),
      nz(static_cast<float>(point.normal.z)),
      vx(static_cast<float>(point.to_viewer.x)),
      vy(static_cast<float>(point.to_viewer.y)),
      vz(static_cast<float>(point.to_viewer.z)),
      cos_view(static_cast<float>(point.cos_view)) {
    const double a2 = point.roughness * point.roughness * point.roughness * point.roughness;
    alpha2 = static_cast<float>(a2);
    less_alpha2 = static_cast<float>(1 - a2);
    masked_view = static_cast<float>(std::sqrt(a2 + (1 - a2) * point.cos_view * point.cos_view));
}

LightInLobe GlossySums::total() const {
    std::array<float, 6> sum;
    for (std::size_t i = 0; i < 6; ++i) {
        // Adds one half to the other until one number remains, because compilers vectorise this form.
        std::array<float, LampTable::block> partial;
        std::ranges::copy(values[i], partial.begin());
        for (std::size_t half = LampTable::block / 2; half > 0; half /= 2)
            for (std::size_t k = 0; k < half; ++k) partial[k] += partial[half + k];
        sum[i] = partial[0];
    }
    return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
}

LightInLobe gloss_plain(const LampTable& lamps, const float* visibility, const GlossyPoint& point) {
    const GlossyFloats surface(point);
    constexpr auto half_per_pi = static_cast<float>(0.5 * std::numbers::inv_pi);
    GlossySums sums;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const float arriving = visibility[i];
        if (!(arriving * lamps.r[i] > 0 || arriving * lamps.g[i] > 0 || arriving * lamps.b[i] > 0)) continue;
        const float wx = lamps.x[i] - lamps.is_point[i] * surface.px, wy = lamps.y[i] - lamps.is_point[i] * surface.py,
                    wz = lamps.z[i] - lamps.is_point[i] * surface.pz;
        const float squared = wx * wx + wy * wy + wz * wz;
        const float per_distance = 1 / std::sqrt(squared);
        const float cos_light = (surface.nx * wx + surface.ny * wy + surface.nz * wz) * per_distance;
        const float towards = (surface.vx * wx + surface.vy * wy + surface.vz * wz) * per_distance;
        // The sum of the directions to the light and to the viewer has the length √(2 + 2 l·v).
        const float half_squared = 2 + 2 * towards;
        if (!(squared > 0 && cos_light > 0 && half_squared > 0)) continue;
        const float per_between = 1 / std::sqrt(half_squared);
        const float cos_half = (cos_light + surface.cos_view) * per_between, view_half = (1 + towards) * per_between;
        const float d = 1 - cos_half * cos_half * surface.less_alpha2;
        const float masked_light = std::sqrt(surface.alpha2 + surface.less_alpha2 * cos_light * cos_light);
        const float visible = surface.cos_view * masked_light + cos_light * surface.masked_view;
        // Factor of the intensity: D V n·l times visibility, over the squared distance.
        const float falloff = lamps.is_point[i] > 0 ? 1 / squared : 1;
        const float peak = surface.alpha2 * half_per_pi / (d * d * visible) * cos_light * (arriving * falloff);
        const float complement = 1 - std::min(view_half, 1.0f), complement2 = complement * complement,
                    grazing = complement2 * complement2 * complement;
        const float at_grazing = peak * grazing, at_normal = peak - at_grazing;
        const std::array<float, 3> intensity{lamps.r[i], lamps.g[i], lamps.b[i]};
        for (std::size_t c = 0; c < 3; ++c) {
            sums.values[c][i % LampTable::block] += at_normal * intensity[c];
            sums.values[3 + c][i % LampTable::block] += at_grazing * intensity[c];
        }
    }
    return sums.total();
}

}  // namespace hogel::shading
