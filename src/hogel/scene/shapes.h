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
/// A ball whose poles are along `axis`, in rings at the given latitudes (from -π/2 to π/2, both included). Two rings
/// close to each other make a sharp boundary between two colours.
void add_ball(MeshBuilder& builder, Vec3 center, double radius, Vec3 axis, std::size_t columns,
              std::span<const Ring> rings);

/// A ball of one colour in evenly spaced rings, its poles above and below.
void add_ball(MeshBuilder& builder, Vec3 center, double radius, std::size_t columns, std::size_t rows, Rgb color);

/// A round tube along a path at(0), …, at(steps), with radius(0), …, radius(steps), closed by flat ends. The path must
/// not bend by 180 degrees in one step.
void add_tube(MeshBuilder& builder, std::size_t columns, std::size_t steps, const std::function<Vec3(std::size_t)>& at,
              const std::function<double(std::size_t)>& radius, const std::function<Rgb(Vec3)>& color);

/// A straight tube of constant radius.
void add_rod(MeshBuilder& builder, Vec3 from, Vec3 to, double radius, std::size_t columns, Rgb color);

/// A ring: a tube of radius `thickness` around the circle of the given radius in the plane through `center` that is
/// perpendicular to `axis`.
void add_torus(MeshBuilder& builder, Vec3 center, Vec3 axis, double radius, double thickness, std::size_t around,
               std::size_t columns, Rgb color);

/// A box whose faces are grids of patches no longer than `patch`. Each face has its own vertices.
void add_box(MeshBuilder& builder, Vec3 low, Vec3 high, double patch, const std::function<Rgb(Vec3)>& color);

/// Gives the meshes of that name a glossy lobe (see Material).
void polish(Scene& scene, std::string_view mesh, float reflectance, float metallic, float roughness);

/// Removes triangles with (almost) no area, as surfaces of revolution have at their poles.
void drop_slivers(Mesh& mesh);

/// Two unit vectors that form a right-handed frame with the unit vector `along`: first × second = along.
struct Across {
    Vec3 first, second;
};
Across across(Vec3 along);

}  // namespace hogel::scene
