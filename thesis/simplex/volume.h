// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "hogel/light_field.h"
#include "hogel/shading.h"
#include "thesis/simplex/product_paths.h"

namespace hogel::simplex {

/// Coordinates of a projected point: U and V as column and row of the picture, S = s/ζ and T = t/ζ with s and t as
/// column and row of hogels relative to the tile's first, and Q = 1/ζ. Samples are at whole numbers of U, V, S/Q and
/// T/Q. On a side of a hemicube the distance forward replaces ζ; it also depends on the camera point.
namespace axis {
enum : std::size_t { u, v, s, t, q };
}

/// Point of a projected volume. Affine functions of the triangle point and of the camera point, divided by ζ, are
/// linear in each other, so points in between are weighted means. Source: [K] (5.2), in units of samples.
using ProjectedPoint = std::array<double, 5>;

/// N-simplex: the convex hull of N + 1 points, in no particular order. Source: [K] 5.6.
template <std::size_t N>
using Simplex = std::array<ProjectedPoint, N + 1>;

/// Triangle in (x, y, ζ).
using DeepTriangle = std::array<std::array<double, 3>, 3>;
DeepTriangle deep_triangle(const ShadedScene& scene, std::size_t index);

/// Returns the smallest depth at which a perspective projection is accurate enough: a millionth of the scene's size.
/// Throws Error(usage) naming the renderer unless the whole scene is behind the hologram plane.
double near_plane(const ShadedScene& scene, std::string_view renderer);

/// Returns the part of a triangle at depths of at least `near` > 0, as zero, one or two triangles. Source: [K] 5.7.
std::vector<DeepTriangle> clip_to_near_plane(const DeepTriangle& triangle, double near);

/// Returns the distance forward below which every ray of a face has a depth of less than `near`.
double min_forward_distance(const LightFieldGrid& grid, double near);

/// Point of the camera plane: column and row of hogels relative to the tile's first.
struct CameraPoint {
    double s = 0, t = 0;
};

/// Returns the projected corners of a triangle from `camera`, a point of the tile that starts with hogel (s0, t0) of
/// the grid. Source: [K] (5.2).
std::array<ProjectedPoint, 3> project(const DeepTriangle& triangle, CameraPoint camera, const LightFieldGrid& grid,
                                      const HogelRange& range);

/// Parts of a tile's rectangle of camera points that see a triangle's front or its back, separated by the intersection
/// of the triangle's plane with the camera plane. Each is empty, a polygon of three to five corners, or the full
/// rectangle. Source: [K] 5.7.1. Differs: the part that sees the back is kept; callers cull back faces.
struct RegionSides {
    std::vector<CameraPoint> front, back;
};
RegionSides split_at_back_face(const DeepTriangle& triangle, const LightFieldGrid& grid, const HogelRange& range);

/// RegionSides for one row of hogels: one or two lines of camera points.
struct CameraLine {
    CameraPoint first, last;
    bool front_visible = false;
};
std::vector<CameraLine> split_row_at_back_face(const DeepTriangle& triangle, std::size_t row,
                                               const LightFieldGrid& grid, const HogelRange& range);

/// Appends the volume of a triangle seen from a convex region of camera points, all on one side of the triangle. A
/// region of three corners gives a (2,2)-simploid and 6 simplices, four corners a (2,1,1)-simploid and 12, five corners
/// both and 18. Source: [K] 5.7.1, fig. 5.17 and 5.22. Differs: a quadrilateral is treated as two triangles, which
/// gives the same twelve simplices. On a side of a hemicube a triangle may be in front of one hogel and behind its
/// neighbour; simplices are clipped at the distance `min_forward` before the division.
void append_projected_volume(const DeepTriangle& triangle, const std::vector<CameraPoint>& region,
                             const LightFieldGrid& grid, const HogelRange& range, std::vector<Simplex<4>>& simplices,
                             double min_forward = 0);

/// Appends the volume in (S, U, V) of a triangle seen from a line of camera points of one t: a (2,1)-simploid or 3
/// simplices. Source: [K] fig. 5.17c.
void append_projected_volume(const DeepTriangle& triangle, const CameraLine& line, const LightFieldGrid& grid,
                             const HogelRange& range, std::vector<Simplex<3>>& simplices, double min_forward = 0);

}  // namespace hogel::simplex
