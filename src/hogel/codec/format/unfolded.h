// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hogel/compress.h"

namespace hogel::codec::format {

/// Hemicube unfolded into one array of directions ([K] 4.2.3): the sides surround the front and continue its picture;
/// the corners of the array belong to no face.
class Unfolding {
  public:
    /// Throws Error(usage) unless there are five faces and the sides have as many directions along the front's edges as
    /// the front.
    explicit Unfolding(std::span<const LightFieldGrid> faces);

    /// Returns the grid of the array, with the steps ΔU and ΔV of the front. Its u() and v() are valid only in the
    /// front's part of the array; for the sides use the grid of the face.
    const LightFieldGrid& grid() const { return grid_; }
    const DirectionCross& cross() const { return cross_; }
    /// First row and column of a face in the array.
    struct Origin {
        std::size_t u, v;
    };
    Origin origin(Face face) const;
    /// Fills the corners of an array [n_V][n_U] with filled faces. Along each edge of a corner, a band of `band`
    /// samples continues the side with the samples of its neighbour around the cube's edge. A cubic fades the band into
    /// the mean of the faces' samples in the same quarter of the array.
    void fill_corners(View<float, 2> array) const;
    static constexpr std::size_t band = 8;

  private:
    LightFieldGrid grid_;
    DirectionCross cross_;
};

/// Returns Σ (f − f')² over the directions that count, without samples that are not finite.
double squared_error(const LightFieldTile& truth, const LightFieldTile& decoded, const DirectionCross& counted);

/// Returns a source that unfolds the faces of a hemicube on reading. Throws Error(usage) as Unfolding does.
LightField::Source unfold(const LightField& light_field);

}  // namespace hogel::codec::format
