// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/vertex_visibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "hogel/scene.h"
#include "hogel/shading/illumination.h"
#include "hogel/shading/lighting.h"
#include "hogel/work/parallel.h"

namespace hogel::shading {
namespace {

constexpr std::size_t visible_vertices_per_task = 16;
// Triangle sizes as fractions of the scene's diagonal; below `min_side` they are finer than usual hogels.
constexpr double min_side = 0.004, coarse_side = 0.012;
// Minimum fraction of a lamp in the total light. Stairs of a fainter lamp are hardly visible. With many lamps each is a
// small part: smoothing the edges of a church's thirty lamps took 0.2 s of the 1.5 s of a light field.
constexpr float min_part = 0.15f;
constexpr std::size_t max_lights = 4;
constexpr std::size_t max_vertices = 50'000'000;  // 800 MB of irradiance
// Number of parts along a side of a triangle. Samples are at the middles of the resulting small triangles.
constexpr int coarse_parts = 3, fine_parts = 2;

using Weights = std::array<float, 3>;

/// Returns the middles of the parts of a triangle, as weights of its corners.
template <int parts>
std::array<Weights, parts * parts> middles() {
    std::array<Weights, parts * parts> weights{};
    std::size_t n = 0;
    const auto add = [&](double b, double c) {
        weights[n++] = {static_cast<float>(1 - (b + c) / parts), static_cast<float>(b / parts),
                        static_cast<float>(c / parts)};
    };
    for (int i = 0; i < parts; ++i)
        for (int k = 0; i + k < parts; ++k) {
            add(i + 1.0 / 3, k + 1.0 / 3);
            if (i + k + 1 < parts) add(i + 2.0 / 3, k + 2.0 / 3);
        }
    return weights;
}

float brightness(Rgb light) { return std::max({light.r, light.g, light.b}); }

// Weight of a corner of a triangle without a shadow edge: fully lit or fully in shadow.
constexpr float third = 1 / 3.0f;

}  // namespace

bool VertexVisibility::suits(const Scene& scene) {
    std::size_t vertices = 0;
    for (const Mesh& mesh : scene.meshes) vertices += mesh.positions.size();
    return scene.lights.size() <= max_lights && vertices <= max_vertices;
}

VertexVisibility::VertexVisibility(const Scene& scene, const ShadedScene& shaded, const trace::RayCaster& caster)
    : scene_(scene),
      shaded_(shaded),
      caster_(caster),
      signed_irradiance_(scene.lights.size(), std::vector<float>(shaded.positions.size())),
      totals_(shaded.positions.size(), std::numbers::pi_v<float> * brightness(scene.ambient)) {
    const Bounds box = bounds(scene);
    diagonal_ = length(box.high - box.low);
    const double scene_offset = ray_offset(scene);
    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        parts_.push_back({&mesh, base, ray_offset(mesh, scene_offset)});
        base += mesh.positions.size();
        if (mesh.radiance.empty() && !mesh.normals.empty()) trace_vertices(parts_.back());
    }
}

// Vertex by vertex, because rays with a common origin visit the same nodes of the tree.
void VertexVisibility::trace_vertices(const Part& part) {
    const Mesh& mesh = *part.mesh;
    const std::size_t n = mesh.positions.size();
    work::parallel_for((n + visible_vertices_per_task - 1) / visible_vertices_per_task, [&](std::size_t task) {
        const std::size_t first = task * visible_vertices_per_task;
        for (std::size_t i = first; i < std::min(n, first + visible_vertices_per_task); ++i)
            for (std::size_t k = 0; k < signed_irradiance_.size(); ++k) {
                const float signed_irradiance = trace(scene_.lights[k], part, mesh.positions[i], mesh.normals[i]);
                signed_irradiance_[k][part.base + i] = signed_irradiance;
                totals_[part.base + i] += brightness(scene_.lights[k].intensity) * std::max(signed_irradiance, 0.0f);
            }
    });
}

std::vector<float> VertexVisibility::irradiance(std::size_t light) const {
    std::vector<float> values = signed_irradiance_[light];
    for (float& value : values) value = std::max(value, 0.0f);
    if (scene_.lights[light].casts_shadows) smooth(scene_.lights[light], signed_irradiance_[light], values);
    return values;
}

// Returns the irradiance per intensity at a point, negative in shadow.
float VertexVisibility::trace(const Light& light, const Part& part, Vec3 point, Vec3 normal) const {
    const Illumination illumination = illuminate(light, point);
    const double cosine = dot(normal, illumination.to_light);
    if (!(cosine > 0)) return 0;
    const bool hidden = light.casts_shadows &&
                        caster_.occluded(point + part.offset * normal, illumination.to_light, 0, illumination.distance);
    const auto signed_irradiance = static_cast<float>(illumination.falloff * cosine);
    return hidden ? -signed_irradiance : signed_irradiance;
}

double VertexVisibility::longest_side(const ShadedScene::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertices;
    const Vec3 ab = shaded_.positions[b] - shaded_.positions[a], bc = shaded_.positions[c] - shaded_.positions[b];
    return std::max({length(ab), length(bc), length(ab + bc)});
}

// Returns whether a visible shadow edge crosses a triangle that is not fine.
bool VertexVisibility::is_crossed(const Light& light, const std::vector<float>& signed_irradiance,
                                  const ShadedScene::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertices;
    const float low = std::min({signed_irradiance[a], signed_irradiance[b], signed_irradiance[c]}),
                high = std::max({signed_irradiance[a], signed_irradiance[b], signed_irradiance[c]});
    if (!(low < 0 && high > 0)) return false;
    const float total = std::max({totals_[a], totals_[b], totals_[c]});
    return brightness(light.intensity) * std::max(high, -low) > min_part * total &&
           longest_side(triangle) > min_side * diagonal_;
}

VertexVisibility::Shares VertexVisibility::sample(const Light& light, const ShadedScene::Triangle& triangle) const {
    static const auto coarse = middles<coarse_parts>();
    static const auto fine = middles<fine_parts>();
    const bool is_coarse = longest_side(triangle) > coarse_side * diagonal_;
    const std::span<const Weights> samples = is_coarse ? std::span<const Weights>(coarse) : fine;
    const Part& part = parts_[triangle.mesh];
    const float share = 1 / static_cast<float>(samples.size());
    Shares shares;
    for (const Weights& weights : samples) {
        Vec3 point, normal;
        for (std::size_t k = 0; k < 3; ++k) {
            point += double{weights[k]} * shaded_.positions[triangle.vertices[k]];
            normal += double{weights[k]} * part.mesh->normals[triangle.vertices[k] - part.base];
        }
        if (!(length(normal) > 0)) continue;
        const float signed_irradiance = trace(light, part, point, normalize(normal));
        if (signed_irradiance == 0) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            shares.all[k] += share * weights[k];
            if (signed_irradiance > 0) shares.lit[k] += share * weights[k];
        }
    }
    return shares;
}

void VertexVisibility::smooth(const Light& light, const std::vector<float>& signed_irradiance,
                              std::vector<float>& irradiance) const {
    std::vector<std::uint32_t> crossed;
    for (std::uint32_t i = 0; i < shaded_.triangles.size(); ++i)
        if (is_crossed(light, signed_irradiance, shaded_.triangles[i])) crossed.push_back(i);
    if (crossed.empty()) return;
    std::vector<Shares> sampled(crossed.size());
    work::parallel_for(crossed.size(),
                       [&](std::size_t i) { sampled[i] = sample(light, shaded_.triangles[crossed[i]]); });
    std::vector<char> at_edge(signed_irradiance.size());
    for (const std::uint32_t i : crossed)
        for (const std::uint32_t vertex : shaded_.triangles[i].vertices) at_edge[vertex] = 1;
    struct Sums {
        double all = 0, lit = 0;
    };
    std::vector<Sums> sums(signed_irradiance.size());
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < shaded_.triangles.size(); ++i) {
        const ShadedScene::Triangle& triangle = shaded_.triangles[i];
        const auto& [a, b, c] = triangle.vertices;
        if (!at_edge[a] && !at_edge[b] && !at_edge[c]) continue;
        Shares shares;
        if (next < crossed.size() && crossed[next] == i)
            shares = sampled[next++];
        else
            for (std::size_t k = 0; k < 3; ++k) {
                shares.all[k] = signed_irradiance[triangle.vertices[k]] != 0 ? third : 0;
                shares.lit[k] = signed_irradiance[triangle.vertices[k]] > 0 ? third : 0;
            }
        const Vec3 origin = shaded_.positions[a];
        const double area = length(cross(shaded_.positions[b] - origin, shaded_.positions[c] - origin));
        for (std::size_t k = 0; k < 3; ++k) {
            sums[triangle.vertices[k]].all += area * double{shares.all[k]};
            sums[triangle.vertices[k]].lit += area * double{shares.lit[k]};
        }
    }
    for (std::size_t i = 0; i < signed_irradiance.size(); ++i)
        if (at_edge[i] && signed_irradiance[i] != 0 && sums[i].all > 0)
            irradiance[i] = std::abs(signed_irradiance[i]) * static_cast<float>(sums[i].lit / sums[i].all);
}

}  // namespace hogel::shading
