// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "hogel/scene/mesh_builder.h"

namespace hogel::scene {

/// A ring of vertices of a ball.
struct Ring {
    double latitude;
    Rgb color;
};
/// Adds a ball with poles on `axis`, in rings at latitudes from -π/2 to π/2; close rings make a sharp colour edge.
void add_ball(MeshBuilder& builder, Vec3 center, double radius, Vec3 axis, std::size_t columns,
              std::span<const Ring> rings);

/// Adds a ball of one colour in evenly spaced rings, with vertical axis.
void add_ball(MeshBuilder& builder, Vec3 center, double radius, std::size_t columns, std::size_t rows, Rgb color);

/// Adds a tube along point(0), …, point(steps) with flat ends. The path must not bend by 180 degrees in a step.
void add_tube(MeshBuilder& builder, std::size_t columns, std::size_t steps,
              const std::function<Vec3(std::size_t)>& point, const std::function<double(std::size_t)>& radius,
              const std::function<Rgb(Vec3)>& color);

void add_rod(MeshBuilder& builder, Vec3 from, Vec3 to, double radius, std::size_t columns, Rgb color);

/// Adds a tube of radius `thickness` around a circle about `center`, perpendicular to `axis`.
void add_torus(MeshBuilder& builder, Vec3 center, Vec3 axis, double radius, double thickness, std::size_t around,
               std::size_t columns, Rgb color);

/// Adds a box with faces of patches no longer than `patch`. Each face has its own vertices.
void add_box(MeshBuilder& builder, Vec3 low, Vec3 high, double patch, const std::function<Rgb(Vec3)>& color);

/// Sets the glossy lobe of the meshes of that name (see Material).
void polish(Scene& scene, std::string_view mesh, float reflectance, float metallic, float roughness);

/// Removes (almost) degenerate triangles, such as those at the poles of surfaces of revolution.
void drop_slivers(Mesh& mesh);

/// Two unit vectors that form a right-handed frame with the unit vector `along`: first × second = along.
struct Across {
    Vec3 first, second;
};
Across across(Vec3 along);

}  // namespace hogel::scene
