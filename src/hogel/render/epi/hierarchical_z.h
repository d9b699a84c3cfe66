// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

/// Bounds of a cluster's box relative to the rays of an epipolar plane, in single precision.
struct BoxBounds {
    float x_low, x_high, z_low, z_high;
    float margin;             ///< in columns; exceeds the rounding error of the columns that see the box
    std::uint32_t min_depth;  ///< ordered bits of a depth in front of everything in the box

    /// Computes the bounds of the box moved by (shift, −z0).
    BoxBounds(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0);
};

/// Columns whose samples may see a box, for `rows` rows of a plane's cells (DepthCells).
struct alignas(64) CellColumns {
    static constexpr std::size_t rows = 16;
    static constexpr std::size_t max_plane_columns = 0xffff;
    std::uint16_t first[rows], count[rows];

    /// Returns the number of CellColumns that cover all rows of cells of a plane.
    static std::size_t needed(std::size_t directions) { return (DepthCells::rows(directions) + rows - 1) / rows; }
};

struct FootprintBounds {
    std::uint32_t min_depth;    ///< of BoxBounds
    std::uint32_t max_columns;  ///< largest number of columns that see the box in one row of cells
};

struct BoxFootprint {
    const CellColumns* columns;  ///< array of CellColumns::needed() elements
    FootprintBounds bounds;
};

/// Finds the cells whose samples may see a box moved by (shift, −z0). Both versions give the same result.
/// @param columns  output, CellColumns::needed(plane.directions) elements
FootprintBounds find_footprint_plain(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0,
                                     CellColumns* columns);
extern decltype(find_footprint_plain)& find_footprint;

/// Footprints of all clusters' boxes for one row of hogels, each computed at its first use.
class BoxFootprints {
  public:
    /// Begins a row of hogels.
    /// @param plane  any plane of the row; must outlive the row
    void begin_row(std::span<const ClusterBox> boxes, const EpipolarPlane& plane, double shift, double z0);
    BoxFootprint operator[](std::size_t box) {
        CellColumns* columns = &columns_[box * columns_per_box_];
        Found& found = found_[box];
        if (found.row != row_) found = {find_footprint(boxes_[box], *plane_, shift_, z0_, columns), row_};
        return {columns, found.bounds};
    }
    void prefetch(std::size_t box) const {
        __builtin_prefetch(&columns_[box * columns_per_box_]);
        __builtin_prefetch(&found_[box]);
    }

  private:
    struct Found {
        FootprintBounds bounds;
        std::uint32_t row;  // for which the footprint was computed
    };

    std::span<const ClusterBox> boxes_;
    const EpipolarPlane* plane_ = nullptr;
    double shift_ = 0, z0_ = 0;
    std::uint32_t row_ = 0;  // counted from 1
    std::size_t columns_per_box_ = 0;
    std::vector<CellColumns, CacheLineAllocator<CellColumns>> columns_;
    std::vector<Found> found_;
};

/// Returns whether all samples in a footprint's cells are nearer than the box. Both versions give the same result.
bool cells_occlude_plain(const EpipolarPlane& plane, const BoxFootprint& box);
extern decltype(cells_occlude_plain)& cells_occlude;

/// Hierarchical z of an epipolar plane (DepthCells). Anything behind it need not be drawn.
class HierarchicalZ {
  public:
    /// Clears the cells for an empty plane.
    void clear(const EpipolarPlane& plane);
    /// Updates the plane's cells from everything drawn so far.
    void update(const EpipolarPlane& plane);
    /// Returns whether the drawn samples occlude the box. Conservative: never true if the box contains something
    /// visible or something as near as a visible sample.
    bool occludes(BoxFootprints& footprints, std::size_t box, const EpipolarPlane& plane) const {
        return pays_ && cells_occlude(plane, footprints[box]);
    }

  private:
    bool pays_ = false;  // whether enough is covered for box tests to save time
};

}  // namespace hogel::render::epi
