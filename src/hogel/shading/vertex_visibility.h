// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hogel/shading.h"
#include "hogel/trace/ray_caster.h"

namespace hogel::shading {

/// Light of each lamp on the vertices of a scene, numbered as in the shaded scene.
class VertexVisibility {
  public:
    /// Returns whether shadow edges should be smoothed: with few lights, each a large part of the total.
    static bool suits(const Scene& scene);

    /// Traces a shadow ray from each vertex to each light.
    /// @param caster  from shadow_caster(); all three arguments must outlive this object
    VertexVisibility(const Scene& scene, const ShadedScene& shaded, const trace::RayCaster& caster);

    /// Returns the irradiance from a light per intensity at each vertex, after shadows. Away from shadow edges the
    /// shadow ray decides. Near triangles that a shadow edge crosses, the result is a mean over the triangles around
    /// the vertex, so that interpolation gives a smooth edge without stairs. Triangles finer than 1/250 of the scene,
    /// and lights that are a small part of the total, show no stairs and are not smoothed. Zero on back-facing surfaces
    /// and on meshes with given radiance.
    std::vector<float> irradiance(std::size_t light) const;

  private:
    struct Part {
        const Mesh* mesh;
        std::size_t base;
        double offset;
    };
    /// Means over a triangle's samples of each corner's weight: over all samples, and over lit samples.
    struct Shares {
        std::array<float, 3> all{}, lit{};
    };

    float trace(const Light& light, const Part& part, Vec3 point, Vec3 normal) const;
    void trace_vertices(const Part& part);
    bool is_crossed(const Light& light, const std::vector<float>& signed_irradiance,
                    const ShadedScene::Triangle& triangle) const;
    double longest_side(const ShadedScene::Triangle& triangle) const;
    Shares sample(const Light& light, const ShadedScene::Triangle& triangle) const;
    void smooth(const Light& light, const std::vector<float>& signed_irradiance, std::vector<float>& irradiance) const;

    const Scene& scene_;
    const ShadedScene& shaded_;
    const trace::RayCaster& caster_;
    double diagonal_;
    std::vector<Part> parts_;
    /// Irradiance per intensity [light][vertex]: negative in shadow, zero on back-facing surfaces.
    std::vector<std::vector<float>> signed_irradiance_;
    std::vector<float> totals_;  ///< irradiance of all lights and of ambient light on each vertex
};

}  // namespace hogel::shading
