// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// The share of each light that arrives at the vertices of a scene, numbered as in the shaded scene.
class VertexVisibility {
  public:
    /// @param caster  as from shadow_caster(); all three must live as long as this
    VertexVisibility(const Scene& scene, const ShadedScene& shaded, const trace::RayCaster& caster);

    /// 1 or 0 by a shadow ray or, on triangles through which the edge of a shadow goes, a mean over the triangles
    /// around the vertex, so that interpolation gives a smooth edge instead of stairs. Triangles finer than a 250th of
    /// the scene have no such stairs. Zero where the surface faces away and on meshes that bring their radiance.
    std::vector<float> of(const Light& light);

  private:
    enum class State : std::uint8_t { unlit, shadow, lit };  // unlit: it faces away
    struct Part {
        const Mesh* mesh;
        std::size_t base;
        double offset;
    };
    /// Of one triangle, the means over its samples for each corner: of the corner's weights, and of those in light.
    struct Shares {
        std::array<float, 3> all{}, lit{};
    };

    State trace(const Light& light, const Part& part, Vec3 point, Vec3 normal) const;
    void trace_vertices(const Light& light, const Part& part);
    bool is_crossed(const ShadedScene::Triangle& triangle) const;
    double longest_side(const ShadedScene::Triangle& triangle) const;
    Shares sample(const Light& light, const ShadedScene::Triangle& triangle) const;
    Shares whole(const ShadedScene::Triangle& triangle) const;
    void smooth(const Light& light, std::vector<float>& visible) const;

    const ShadedScene& shaded_;
    const trace::RayCaster& caster_;
    double diagonal_;
    std::vector<Part> parts_;
    std::vector<State> states_;
};

}  // namespace hogel::shading
