// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/light_field.h"
#include "hogel/render/span.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

/// The directions in which hogels of a tile may see a triangle, one axis at a time. Along U a triangle is seen by the
/// hogels between the ends of x − Uζ, whatever V is; where that is no column of hogels, no slice at U holds a sample. V
/// and rows alike. Triangles that are smaller than the hogels are apart are seen in few of the directions that their
/// volumes reach.
///
/// On the sides of a hemicube, where ζ depends on the hogel, all directions count as seen.
class SeenDirections {
  public:
    explicit SeenDirections(const LightFieldGrid& grid);

    /// Finds the directions in which hogels of a tile see a part of a triangle that lies behind the near plane. Returns
    /// false if there are none.
    bool find(const DeepTriangle& triangle, const HogelRange& range);

    /// For each column of directions, whether any hogel may see the triangle in it.
    std::span<const std::uint8_t> u() const { return u_.seen; }
    /// For each row of directions.
    std::span<const std::uint8_t> v() const { return v_.seen; }

  private:
    // One axis: U and the columns of hogels, or V and their rows.
    struct Axis {
        std::vector<std::uint8_t> seen;
        render::Span filled;  // outside of which nothing is seen
    };
    // The hogels of a tile along an axis: position of the first, step, number.
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
