// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/light_field.h"
#include "hogel/render/span.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

/// Directions in which hogels of a tile may see a triangle, one axis at a time. For a given U, a triangle is visible
/// from the hogels between the ends of x − Uζ, independently of V. If no column of hogels is in this range, no slice at
/// U has a sample. The same holds for V and rows. Triangles smaller than the pitch of hogels are visible in few of the
/// directions that their volumes cover.
///
/// On the sides of a hemicube ζ depends on the hogel, and all directions count as visible.
class SeenDirections {
  public:
    explicit SeenDirections(const LightFieldGrid& grid);

    /// Finds the directions in which hogels of a tile see a part of a triangle that lies behind the near plane. Returns
    /// false if there are none.
    bool find(const DeepTriangle& triangle, const HogelRange& range);

    /// Returns for each column of directions whether any hogel may see the triangle in it.
    std::span<const std::uint8_t> u() const { return u_.seen; }
    /// Returns the same for each row of directions.
    std::span<const std::uint8_t> v() const { return v_.seen; }

  private:
    // One axis: U and the columns of hogels, or V and the rows.
    struct Axis {
        std::vector<std::uint8_t> seen;
        render::Span filled;  // no direction outside of it is seen
    };
    // Hogels of a tile along an axis: position of the first, step, number.
    struct Hogels {
        double first, step;
        std::size_t count;
    };
    template <class Direction, class Index>
    static bool find(const DeepTriangle& triangle, std::size_t coordinate, const Hogels& hogels,
                     const Direction& direction, const Index& index, Axis& axis);

    const LightFieldGrid grid_;
    Axis u_, v_;
};

}  // namespace hogel::simplex
