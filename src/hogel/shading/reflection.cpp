// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/reflection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace hogel::shading {
namespace {

using std::numbers::pi;

double schlick(double cosine) {
    const double complement = 1 - std::clamp(cosine, 0.0, 1.0), squared = complement * complement;
    return squared * squared * complement;
}

double distribution(double cos_half, double alpha) {
    const double a2 = alpha * alpha, d = cos_half * cos_half * (a2 - 1) + 1;
    return a2 / (pi * d * d);
}

/// Returns Smith's masking and shadowing over 4 (n·l)(n·v).
double visibility(double cos_light, double cos_view, double alpha) {
    const double a2 = alpha * alpha;
    const double l = cos_view * std::sqrt(a2 + (1 - a2) * cos_light * cos_light);
    const double v = cos_light * std::sqrt(a2 + (1 - a2) * cos_view * cos_view);
    return 0.5 / (l + v);
}

/// Computes the albedo by a sum over facet normals distributed as in the lobe.
LobeAlbedo integrate(double cosine, double roughness) {
    constexpr std::uint32_t samples = 1024;
    const double alpha = roughness * roughness;
    const Vec3 to_viewer{std::sqrt(1 - cosine * cosine), 0, cosine};
    LobeAlbedo sum{0, 0};
    for (std::uint32_t i = 0; i < samples; ++i) {
        // Hammersley points: i/n, and i with its binary digits reversed.
        std::uint32_t bits = i;
        double reversed = 0;
        for (double digit = 0.5; bits != 0; bits >>= 1, digit *= 0.5) reversed += bits & 1 ? digit : 0;
        const double x = (i + 0.5) / samples, angle = 2 * pi * reversed;
        const double cos_half = std::sqrt((1 - x) / (1 + (alpha * alpha - 1) * x));
        const double sin_half = std::sqrt(1 - cos_half * cos_half);
        const Vec3 half{sin_half * std::cos(angle), sin_half * std::sin(angle), cos_half};
        const double view_half = dot(to_viewer, half);
        const double cos_light = 2 * view_half * cos_half - cosine;
        if (!(cos_light > 0 && view_half > 0)) continue;
        const double weight = 4 * visibility(cos_light, cosine, alpha) * cos_light * view_half / cos_half;
        const double grazing = schlick(view_half);
        sum.scale += weight * (1 - grazing) / samples;
        sum.offset += weight * grazing / samples;
    }
    return sum;
}

constexpr std::size_t table_cells = 32;

struct AlbedoTable {
    std::array<std::array<LobeAlbedo, table_cells>, table_cells> albedo;  // [roughness][cosine]
    std::array<LobeAlbedo, table_cells> mean;

    static double cosine(std::size_t i) {
        // Denser towards grazing angles, where the albedo changes rapidly.
        const double x = (static_cast<double>(i) + 1e-3) / (table_cells - 1 + 1e-3);
        return x * x;
    }
    static double roughness(std::size_t k) {
        return min_roughness + (1 - min_roughness) * static_cast<double>(k) / (table_cells - 1);
    }
    AlbedoTable() {
        for (std::size_t k = 0; k < table_cells; ++k) {
            for (std::size_t i = 0; i < table_cells; ++i) albedo[k][i] = integrate(cosine(i), roughness(k));
            // ∫ 2 µ E(µ) dµ with E linear in √µ between nodes, as in look_up().
            LobeAlbedo sum{0, 0};
            constexpr int steps = 512;
            for (int j = 0; j < steps; ++j) {
                const double mu = (j + 0.5) / steps;
                const LobeAlbedo albedo_at_mu = look_up(k, mu);
                sum.scale += 2 * mu * albedo_at_mu.scale / steps;
                sum.offset += 2 * mu * albedo_at_mu.offset / steps;
            }
            mean[k] = sum;
        }
    }
    LobeAlbedo look_up(std::size_t k, double cosine_at) const {
        const double position = std::sqrt(std::clamp(cosine_at, 0.0, 1.0)) * (table_cells - 1);
        const auto i = std::min(static_cast<std::size_t>(position), table_cells - 2);
        const double w = position - static_cast<double>(i);
        const LobeAlbedo &a = albedo[k][i], &b = albedo[k][i + 1];
        return {a.scale + w * (b.scale - a.scale), a.offset + w * (b.offset - a.offset)};
    }
};

const AlbedoTable& table() {
    static const AlbedoTable albedo;
    return albedo;
}

/// Neighbouring rows k and k + 1 of the table, and the weight of the second.
struct Row {
    std::size_t k;
    double weight;
};

Row row_of(double roughness) {
    const double position =
        (std::clamp(roughness, min_roughness, 1.0) - min_roughness) / (1 - min_roughness) * (table_cells - 1);
    const auto k = std::min(static_cast<std::size_t>(position), table_cells - 2);
    return {k, position - static_cast<double>(k)};
}

LobeAlbedo mixed(LobeAlbedo a, LobeAlbedo b, double w) {
    return {a.scale + w * (b.scale - a.scale), a.offset + w * (b.offset - a.offset)};
}

}  // namespace

LobeAlbedo lobe_albedo(double cosine, double roughness) {
    const auto [k, weight] = row_of(roughness);
    return mixed(table().look_up(k, cosine), table().look_up(k + 1, cosine), weight);
}

LobeAlbedo mean_lobe_albedo(double roughness) {
    const auto [k, weight] = row_of(roughness);
    return mixed(table().mean[k], table().mean[k + 1], weight);
}

namespace {

double clamped_roughness(const Material& material) {
    return std::clamp(double{material.roughness}, min_roughness, 1.0);
}

void add_light(LightUnderLobe& sum, bool glossy, double roughness, Rgb irradiance, double cos_light) {
    const double reflected = cos_light * std::numbers::inv_pi;
    if (!glossy) {
        sum.arriving += static_cast<float>(reflected) * irradiance;
        return;
    }
    const LobeAlbedo lobe = lobe_albedo(cos_light, roughness);
    sum.arriving += static_cast<float>(reflected * (1 - lobe.offset)) * irradiance;
    sum.for_lobe += static_cast<float>(reflected * lobe.scale) * irradiance;
}

}  // namespace

void LightUnderLobe::add(const Material& material, Rgb irradiance, double cos_light) {
    add_light(*this, material.is_glossy(), clamped_roughness(material), irradiance, cos_light);
}

Reflection::Reflection(const Material& material, Rgb color, double cos_view)
    : glossy_(material.is_glossy()), diffuse_((1 - material.metallic) * color), cos_view_(cos_view) {
    if (!glossy_) return;
    const float plain = (1 - material.metallic) * material.reflectance;
    lobe_ = Rgb{plain, plain, plain} + material.metallic * color;
    max_lobe_ = std::max({lobe_.r, lobe_.g, lobe_.b});
    roughness_ = clamped_roughness(material);
    albedo_ = lobe_albedo(std::abs(cos_view), roughness_);
    const LobeAlbedo mean = mean_lobe_albedo(roughness_);
    diffuse_scale_ = (1 - (max_lobe_ * albedo_.scale + albedo_.offset)) / (1 - (max_lobe_ * mean.scale + mean.offset));
}

Rgb Reflection::diffuse(const LightUnderLobe& light) const {
    const auto max_lobe = static_cast<float>(max_lobe_);
    return static_cast<float>(diffuse_scale_) * (diffuse_ * (light.arriving + -max_lobe * light.for_lobe));
}

Rgb Reflection::lobe(Vec3 normal, Vec3 to_viewer, Vec3 to_light, double cos_light) const {
    if (!glossy_ || !(cos_view_ > 0) || !(cos_light > 0)) return {0, 0, 0};
    const Vec3 between = to_light + to_viewer;
    const double size = length(between);
    if (!(size > 0)) return {0, 0, 0};
    const double alpha = roughness_ * roughness_, grazing = schlick(dot(to_viewer, between) / size);
    const double peak =
        distribution(dot(normal, between) / size, alpha) * visibility(cos_light, cos_view_, alpha) * cos_light;
    const auto at_normal = static_cast<float>(peak * (1 - grazing)), at_grazing = static_cast<float>(peak * grazing);
    return at_normal * lobe_ + Rgb{at_grazing, at_grazing, at_grazing};
}

Rgb Reflection::towards(Vec3 normal, Vec3 to_viewer, Vec3 to_light, double cos_light) const {
    if (!(cos_light > 0)) return {0, 0, 0};
    LightUnderLobe light;
    add_light(light, glossy_, roughness_, {1, 1, 1}, cos_light);
    return diffuse(light) + lobe(normal, to_viewer, to_light, cos_light);
}

Rgb Reflection::in_uniform_light() const {
    if (!glossy_) return diffuse_;
    const auto remaining = static_cast<float>(1 - (max_lobe_ * albedo_.scale + albedo_.offset));
    const auto scale = static_cast<float>(albedo_.scale), offset = static_cast<float>(albedo_.offset);
    return remaining * diffuse_ + scale * lobe_ + Rgb{offset, offset, offset};
}

}  // namespace hogel::shading
