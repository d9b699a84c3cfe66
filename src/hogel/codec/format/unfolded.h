// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "hogel/light_field.h"

namespace hogel::codec::format {

/// How the faces of a light field are coded: each by itself, or all unfolded into one array, the front in the middle;
/// or each by itself, its hogels gathered into rows of directions, where it has a single row of them (docs/format.md).
enum class StreamLayout { faces, unfolded, gathered };

/// Which directions of an array count: of rows begin_v to end_v all, of others those from begin_u to end_u. By default
/// all of all rows; of an unfolded hemicube its faces without the corners.
struct DirectionCross {
    std::size_t begin_u = 0, end_u = 0, begin_v = 0, end_v = std::numeric_limits<std::size_t>::max();

    struct Columns {
        std::size_t begin, end;
    };
    /// Those of row v that count, of `width`.
    Columns columns(std::size_t v, std::size_t width) const {
        return v >= begin_v && v < end_v ? Columns{0, width} : Columns{begin_u, end_u};
    }
};

/// A hemicube unfolded into one array of directions ([K] 4.2.3): the sides around the front, their pictures continuing
/// each other, and corners that are nobody's.
class Unfolding {
  public:
    /// Throws Error(usage) unless the faces are five, as long along the front's edges as the front itself.
    explicit Unfolding(std::span<const LightFieldGrid> faces);

    /// Of the whole array, with the front's steps of direction; its U and V mean something on the front alone.
    const LightFieldGrid& grid() const { return grid_; }
    const DirectionCross& cross() const { return cross_; }
    /// The row and column of the array where a face begins.
    struct Place {
        std::size_t u, v;
    };
    Place place(Face face) const;
    /// Fills the corners of an array [n_V][n_U] whose faces are there. Strips of `strip` samples along their edges
    /// continue one side by what its neighbour shows around the cube's edge; from there they fade, by a cubic, into the
    /// mean of the faces' samples in the same quarter of the array.
    void fill_corners(View<float, 2> array) const;
    static constexpr std::size_t strip = 8;

  private:
    LightFieldGrid grid_;
    DirectionCross cross_;
};

/// Σ (f − f')² over the directions that count, without what is not finite.
double squared_error(const LightFieldTile& truth, const LightFieldTile& decoded, const DirectionCross& counted);

/// The faces of a hemicube, unfolded where they are read. They must outlive it.
std::unique_ptr<LightFieldSource> unfold(std::span<const LightFieldSource* const> faces);

}  // namespace hogel::codec::format
