// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hogel/compress.h"

namespace hogel::codec::format {

/// A hemicube unfolded into one array of directions ([K] 4.2.3): the sides surround the front and continue its picture;
/// the corners of the array belong to no face.
class Unfolding {
  public:
    /// Throws Error(usage) unless there are five faces and the sides have as many directions along the front's edges as
    /// the front.
    explicit Unfolding(std::span<const LightFieldGrid> faces);

    /// The whole array, with the front's ΔU and ΔV; its U and V are those of directions on the front only.
    const LightFieldGrid& grid() const { return grid_; }
    const DirectionCross& cross() const { return cross_; }
    /// The first row and column of a face in the array.
    struct Place {
        std::size_t u, v;
    };
    Place place(Face face) const;
    /// Fills the corners of an array [n_V][n_U] whose faces are filled. A band of `band` samples along each edge of a
    /// corner continues the side by the samples of its neighbour around the cube's edge, and fades, by a cubic, into
    /// the mean of the faces' samples in the same quarter of the array.
    void fill_corners(View<float, 2> array) const;
    static constexpr std::size_t band = 8;

  private:
    LightFieldGrid grid_;
    DirectionCross cross_;
};

/// Σ (f − f')² over the directions that count, without samples that are not finite.
double squared_error(const LightFieldTile& truth, const LightFieldTile& decoded, const DirectionCross& counted);

/// Unfolds the faces of a hemicube when they are read. Throws Error(usage) as Unfolding does.
LightField::Source unfold(const LightField& light_field);

}  // namespace hogel::codec::format
