// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/scene/mesh_builder.h"

namespace hogel::showpieces {

/// Coordinates of a wall: a to the right, b up, c out of the wall.
struct Frame {
    Vec3 origin, right, up, out;

    Vec3 at(double a, double b, double c) const { return origin + a * right + b * up + c * out; }
};

/// Opening with a round arch, in a wall's coordinates.
struct Opening {
    double center, half_width, sill, spring;
    std::size_t segments;  ///< number of segments of the half circle

    /// Returns point i of the outline, offset by `grow`, from the left foot (0) along the arch to the right foot
    /// (segments + 2).
    std::pair<double, double> outline(std::size_t i, double grow = 0) const;
};

/// Builds stone structures of blocks and small patches, fine enough for shading at the vertices.
class Masonry {
  public:
    scene::MeshBuilder faceted;  ///< each block has its own vertices and shade of stone
    scene::MeshBuilder smooth;

    /// Adds a rectangle a0..a1 × b0..b1 of a wall in courses of blocks.
    void wall(const Frame& frame, double a0, double a1, double b0, double b1, Rgb stone);
    /// Adds a wall around an opening, which must be inside the rectangle (its sill may be on the lower edge).
    void wall_with_opening(const Frame& frame, double a0, double a1, double b0, double b1, const Opening& opening,
                           Rgb stone);
    /// Adds the sides of an opening, `depth` into the wall.
    void reveal(const Frame& frame, const Opening& opening, double depth, Rgb stone);
    /// Adds a reveal closed by a pane at its back.
    void recess(const Frame& frame, const Opening& opening, double depth, Rgb stone, Rgb pane);
    /// Adds a moulding of the given width around an opening, projecting by `projection`.
    void archivolt(const Frame& frame, const Opening& opening, double width, double projection, Rgb stone);
    /// Adds a block that projects from a wall by `projection`.
    void slab(const Frame& frame, double a0, double a1, double b0, double b1, double projection, Rgb stone);
    /// Adds a box in world coordinates, with faces divided into patches no longer than `patch`.
    void box(Vec3 low, Vec3 high, Rgb stone, double patch);
    /// Adds a corner pillar of alternately wide and narrow blocks around `foot`, the centre of its base.
    void quoins(Vec3 foot, double half_width, double height, double block, Rgb stone);
    /// Adds a flat ring (or disc, inner = 0) on a wall, projecting by `projection`.
    void ring(const Frame& frame, double inner, double outer, double projection, Rgb color, std::size_t segments);
    /// Adds a flat bar on a wall from radius r0 to r1 in the direction `angle` (0 up, clockwise).
    void bar(const Frame& frame, double angle, double r0, double r1, double half_width, double projection, Rgb color);
    /// Adds a square pyramid in rows of tiles, with a slight flare at its foot.
    void pyramid(Vec3 foot, double half_width, double height, std::size_t rows, Rgb tile);
    /// Adds a ball and a point on top of a roof.
    void spire(Vec3 foot, Rgb ball, Rgb point);
    /// Adds a hall with a gabled roof and arched windows, from `foot` (the middle of its left end) to the right.
    void hall(Vec3 foot, double length, double half_depth, double eaves, double ridge, Rgb stone, Rgb trim, Rgb pane);
    void lawn(Vec3 center, double half_width, double half_depth);
    void tree(Vec3 foot, double height);

  private:
    void hall_side(const Frame& frame, double length, double half_depth, double eaves, double ridge, Rgb stone,
                   Rgb trim, Rgb pane);
    void hall_gable(const Frame& frame, double half_depth, double eaves, double ridge, Rgb stone);
    void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Rgb color);
    void flat_patch(Vec3 corner, Vec3 right, Vec3 up, Rgb color, double patch);
    Rgb vary(Rgb color, double amount = 0.22);

    std::uint32_t blocks_ = 0;
};

}  // namespace hogel::showpieces
