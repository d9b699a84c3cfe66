// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// The light of each lamp on the vertices of a scene, numbered as in the shaded scene.
class VertexVisibility {
  public:
    /// Whether edges of shadows are to be smooth: where there are few lights. Of many, each is a small part of all.
    static bool suits(const Scene& scene);

    /// Traces a shadow ray from each vertex to each light.
    /// @param caster  as from shadow_caster(); all three must live as long as this
    VertexVisibility(const Scene& scene, const ShadedScene& shaded, const trace::RayCaster& caster);

    /// The irradiance from a light per its intensity, as far as the light arrives: all or nothing by the shadow ray or,
    /// on triangles through which the edge of a shadow goes, a mean over the triangles around the vertex, so that
    /// interpolation gives a smooth edge instead of stairs. Triangles finer than a 250th of the scene have no such
    /// stairs, and a light that is a small part of all has none that are seen. Zero where the surface faces away and on
    /// meshes that bring their radiance.
    std::vector<float> irradiance(std::size_t light) const;

  private:
    struct Part {
        const Mesh* mesh;
        std::size_t base;
        double offset;
    };
    /// Of one triangle, the means over its samples for each corner: of the corner's weights, and of those in light.
    struct Shares {
        std::array<float, 3> all{}, lit{};
    };

    float trace(const Light& light, const Part& part, Vec3 point, Vec3 normal) const;
    void trace_vertices(const Part& part);
    bool is_crossed(const Light& light, const std::vector<float>& reach, const ShadedScene::Triangle& triangle) const;
    double longest_side(const ShadedScene::Triangle& triangle) const;
    Shares sample(const Light& light, const ShadedScene::Triangle& triangle) const;
    void smooth(const Light& light, const std::vector<float>& reach, std::vector<float>& irradiance) const;

    const Scene& scene_;
    const ShadedScene& shaded_;
    const trace::RayCaster& caster_;
    double diagonal_;
    std::vector<Part> parts_;
    /// For each light, and then each vertex, the irradiance per intensity: below zero in a shadow, zero on what faces
    /// away.
    std::vector<std::vector<float>> reach_;
    std::vector<float> totals_;  ///< the irradiance of all lights and of ambient light on each vertex
};

}  // namespace hogel::shading
