// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hogel/compress.h"

namespace hogel::codec::format {

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
