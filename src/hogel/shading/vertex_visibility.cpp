// SPDX-License-Identifier: Apache-2.0
#include "hogel/shading/vertex_visibility.h"

#include <algorithm>
#include <span>

#include "hogel/core/parallel.h"
#include "hogel/scenes.h"
#include "hogel/shading/illumination.h"
#include "hogel/shading/lighting.h"

namespace hogel::shading {
namespace {

constexpr std::size_t vertices_per_task = 16;
// Of the scene's diagonal: what is finer is finer than the hogels of most holograms.
constexpr double min_side = 0.004, coarse_side = 0.012;
// Parts along a side of a triangle, which is sampled in the middles of their squares of equal parts.
constexpr int coarse_parts = 3, fine_parts = 2;

using Weights = std::array<float, 3>;

/// The middles of the parts of a triangle, as weights of its corners.
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

}  // namespace

VertexVisibility::VertexVisibility(const Scene& scene, const ShadedScene& shaded, const trace::RayCaster& caster)
    : shaded_(shaded), caster_(caster) {
    const Bounds box = bounds(scene);
    diagonal_ = length(box.high - box.low);
    const double usual = ray_offset(scene);
    std::size_t base = 0;
    for (const Mesh& mesh : scene.meshes) {
        parts_.push_back({&mesh, base, ray_offset(mesh, usual)});
        base += mesh.positions.size();
    }
}

std::vector<float> VertexVisibility::of(const Light& light) {
    states_.assign(shaded_.positions.size(), State::unlit);
    for (const Part& part : parts_) trace_vertices(light, part);
    std::vector<float> visible(states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) visible[i] = states_[i] == State::lit ? 1.0f : 0.0f;
    if (light.casts_shadows) smooth(light, visible);
    return visible;
}

VertexVisibility::State VertexVisibility::trace(const Light& light, const Part& part, Vec3 point, Vec3 normal) const {
    const Illumination from = illuminate(light, point);
    if (!(dot(normal, from.to_light) > 0)) return State::unlit;
    const bool hidden =
        light.casts_shadows && caster_.occluded(point + part.offset * normal, from.to_light, 0, from.distance);
    return hidden ? State::shadow : State::lit;
}

void VertexVisibility::trace_vertices(const Light& light, const Part& part) {
    const Mesh& mesh = *part.mesh;
    if (!mesh.radiance.empty() || mesh.normals.empty()) return;
    const std::size_t n = mesh.positions.size();
    core::parallel_for((n + vertices_per_task - 1) / vertices_per_task, [&](std::size_t task) {
        const std::size_t first = task * vertices_per_task;
        for (std::size_t i = first; i < std::min(n, first + vertices_per_task); ++i)
            states_[part.base + i] = trace(light, part, mesh.positions[i], mesh.normals[i]);
    });
}

double VertexVisibility::longest_side(const ShadedScene::Triangle& triangle) const {
    const auto& [a, b, c] = triangle.vertices;
    const Vec3 ab = shaded_.positions[b] - shaded_.positions[a], bc = shaded_.positions[c] - shaded_.positions[b];
    return std::max({length(ab), length(bc), length(ab + bc)});
}

// Whether the edge of a shadow goes through a triangle that is not fine.
bool VertexVisibility::is_crossed(const ShadedScene::Triangle& triangle) const {
    const auto is = [&](State state) {
        return std::ranges::any_of(triangle.vertices, [&](auto vertex) { return states_[vertex] == state; });
    };
    return is(State::lit) && is(State::shadow) && longest_side(triangle) > min_side * diagonal_;
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
        const State state = trace(light, part, point, normalize(normal));
        if (state == State::unlit) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            shares.all[k] += share * weights[k];
            if (state == State::lit) shares.lit[k] += share * weights[k];
        }
    }
    return shares;
}

// What a triangle without an edge of a shadow says of its corners: that they are all in light, or all in shadow.
VertexVisibility::Shares VertexVisibility::whole(const ShadedScene::Triangle& triangle) const {
    constexpr float third = 1 / 3.0f;
    Shares shares;
    for (std::size_t k = 0; k < 3; ++k) {
        const State state = states_[triangle.vertices[k]];
        shares.all[k] = state == State::unlit ? 0 : third;
        shares.lit[k] = state == State::lit ? third : 0;
    }
    return shares;
}

void VertexVisibility::smooth(const Light& light, std::vector<float>& visible) const {
    std::vector<std::uint32_t> crossed;
    for (std::uint32_t i = 0; i < shaded_.triangles.size(); ++i)
        if (is_crossed(shaded_.triangles[i])) crossed.push_back(i);
    if (crossed.empty()) return;
    std::vector<Shares> sampled(crossed.size());
    core::parallel_for(crossed.size(),
                       [&](std::size_t i) { sampled[i] = sample(light, shaded_.triangles[crossed[i]]); });
    std::vector<char> at_edge(visible.size());
    for (const std::uint32_t i : crossed)
        for (const std::uint32_t vertex : shaded_.triangles[i].vertices) at_edge[vertex] = 1;
    struct Sums {
        double all = 0, lit = 0;
    };
    std::vector<Sums> sums(visible.size());
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < shaded_.triangles.size(); ++i) {
        const ShadedScene::Triangle& triangle = shaded_.triangles[i];
        const bool is_sampled = next < crossed.size() && crossed[next] == i;
        const auto& [a, b, c] = triangle.vertices;
        if (!is_sampled && !at_edge[a] && !at_edge[b] && !at_edge[c]) continue;
        const Shares shares = is_sampled ? sampled[next++] : whole(triangle);
        const Vec3 origin = shaded_.positions[a];
        const double area = length(cross(shaded_.positions[b] - origin, shaded_.positions[c] - origin));
        for (std::size_t k = 0; k < 3; ++k) {
            sums[triangle.vertices[k]].all += area * double{shares.all[k]};
            sums[triangle.vertices[k]].lit += area * double{shares.lit[k]};
        }
    }
    for (std::size_t i = 0; i < visible.size(); ++i)
        if (at_edge[i] && states_[i] != State::unlit && sums[i].all > 0)
            visible[i] = static_cast<float>(sums[i].lit / sums[i].all);
}

}  // namespace hogel::shading
