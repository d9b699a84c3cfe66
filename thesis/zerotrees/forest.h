// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "thesis/wavelets/pyramid.h"

namespace hogel::zerotrees {

/// Coefficients of a wavelet transform as trees ([K] 4.4.2, fig. 4.15, in any number of dimensions). The parent of a
/// coefficient has the same position and orientation, one level coarser. The parent of the coarsest details is the
/// coarse sample at their position; coarse samples are roots. With several groups of axes the parent is found in each
/// group independently; a group stays at its coarse samples once it has reached them.
///
/// Sizes are arbitrary: the last parent takes the remaining children, one to three. Orientations with details along an
/// axis that is no longer split are children of the nearest orientation without that axis.
class Forest {
  public:
    static constexpr std::size_t no_parent = std::numeric_limits<std::size_t>::max();

    /// Box of coefficients of one level and orientation.
    struct Band {
        std::vector<std::size_t> extent;
        std::size_t origin;
        /// [axis][position in the box]: offset of the parent in the array. The sum over the axes is the index of
        /// the parent.
        std::vector<std::vector<std::size_t>> parents;
        int depth;  ///< depth of its coefficients in their trees, 0 for roots
        bool leaf;  ///< none of its coefficients has children
    };

    /// Throws Error(usage) for more than 8 axes or more than 100000 bands.
    explicit Forest(const wavelets::Pyramid& pyramid);

    /// Returns the bands from roots to leaves: a band follows the band of its parents.
    const std::vector<Band>& bands() const { return bands_; }
    int depth() const { return bands_.back().depth; }
    std::size_t size() const { return size_; }

    /// Calls visit(index, parent) for the coefficients of a band in row-major order; parent is no_parent for roots.
    template <class Visit>
    void for_each(const Band& band, Visit&& visit) const;

  private:
    std::vector<Band> bands_;
    std::vector<std::size_t> strides_;
    std::size_t size_;
};

template <class Visit>
void Forest::for_each(const Band& band, Visit&& visit) const {
    const std::size_t last = band.extent.size() - 1, row_length = band.extent[last];
    const std::size_t* row_parents = band.parents[last].data();
    std::vector<std::size_t> row_position(last);  // position of the row
    for (bool more = true; more;) {
        std::size_t index = band.origin, parent = 0;
        for (std::size_t axis = 0; axis < last; ++axis) {
            index += row_position[axis] * strides_[axis];
            parent += band.parents[axis][row_position[axis]];
        }
        for (std::size_t k = 0; k < row_length; ++k)
            visit(index + k, band.depth == 0 ? no_parent : parent + row_parents[k]);
        more = false;
        for (std::size_t axis = last; axis-- > 0 && !more;) {
            more = ++row_position[axis] < band.extent[axis];
            if (!more) row_position[axis] = 0;
        }
    }
}

}  // namespace hogel::zerotrees
