// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace hogel::wavelets {

/// Axes of an array that are split together, level after level.
struct AxisGroup {
    std::vector<std::size_t> axes;
    int levels;
};

/// Order in which a transform is applied to the dimensions of an array. Each level of a group transforms its axes one
/// after the other in the coarse samples of the previous level; an axis with a single coarse sample is not split. With
/// one group of all axes the transforms are interleaved; several groups are transformed independently, as required for
/// the directions of holograms of basis fringes ([K] 4.2.3). Axes in no group are not transformed. Along each axis the
/// coarse samples come first, then the details from the coarsest to the finest.
class Pyramid {
  public:
    /// Throws Error(usage) for an axis that does not exist or is in two groups, for levels outside 0..62, and for an
    /// array without elements or dimensions, or with more than 2⁴⁰ elements.
    Pyramid(std::vector<std::size_t> shape, std::vector<AxisGroup> groups);

    /// Returns all axes in one group, down to two to four coarse samples of the longest axis.
    static Pyramid interleaved(const std::vector<std::size_t>& shape);
    /// Returns each list of axes as a separate group, with levels chosen as for interleaved().
    static Pyramid separate(const std::vector<std::size_t>& shape, const std::vector<std::vector<std::size_t>>& axes);

    const std::vector<std::size_t>& shape() const { return shape_; }
    const std::vector<AxisGroup>& groups() const { return groups_; }
    std::size_t size() const;
    /// Returns the strides of the row-major array, in elements.
    std::vector<std::size_t> strides() const;
    /// Returns the number of coarse samples of an axis after some levels: ⌈n / 2^level⌉.
    std::size_t coarse_extent(std::size_t axis, int level) const;

  private:
    std::vector<std::size_t> shape_;
    std::vector<AxisGroup> groups_;
};

}  // namespace hogel::wavelets
