// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/kernels.h"

namespace hogel::render::epi {

/// A box as the rays of an epipolar plane see it.
struct BoxBounds {
    float x_low, x_high, z_low, z_high;
    float margin;           ///< beyond any rounding of the columns that see the box
    std::uint32_t nearest;  ///< ordered bits of a depth in front of all that is in it

    /// The box is moved by (shift, −z0) first.
    BoxBounds(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0);
};

/// Of some rows of a plane's cells (PlaneCells) the columns whose samples may see into a box.
struct alignas(64) CellColumns {
    static constexpr std::size_t rows = 16;
    static constexpr std::size_t most = 0xffff;  ///< columns that a plane may have
    std::uint16_t first[rows], count[rows];

    /// So many for all rows of a plane's cells.
    static std::size_t lines(std::size_t directions) { return (PlaneCells::rows(directions) + rows - 1) / rows; }
};

/// Ordered bits of a depth in front of all that is in a box, and how many columns of one row at most see it.
struct BoxDepth {
    std::uint32_t nearest, widest;
};

/// Which samples may see into a box.
struct SeenBox {
    const CellColumns* columns;  ///< as many as it takes for all rows of cells
    BoxDepth depth;
};

/// Finds where the hogels and directions of a plane see a box, which is moved by (shift, −z0) first. The twins find the
/// same.
/// @param columns  of CellColumns::lines(plane.directions)
BoxDepth see_box_plain(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0,
                       CellColumns* columns);
BoxDepth see_box(const ClusterBox& box, const EpipolarPlane& plane, double shift, double z0, CellColumns* columns);

/// Where the hogels of a row see the boxes of all clusters, which is the same in all its planes: found of a box when it
/// is first asked for.
class SeenBoxes {
  public:
    /// From now on of the hogels and directions of this plane, the boxes moved by (shift, −z0) first.
    void begin_row(std::span<const ClusterBox> boxes, const EpipolarPlane& plane, double shift, double z0);
    SeenBox operator[](std::size_t box) {
        CellColumns* columns = &columns_[box * lines_];
        Known& known = known_[box];
        if (known.row != row_) known = {see_box(boxes_[box], *plane_, shift_, z0_, columns), row_};
        return {columns, known.depth};
    }
    /// Asks for what is known of a box before it is needed.
    void prefetch(std::size_t box) const {
        __builtin_prefetch(&columns_[box * lines_]);
        __builtin_prefetch(&known_[box]);
    }

  private:
    struct Known {
        BoxDepth depth;
        std::uint32_t row;  // of which it is known
    };

    std::span<const ClusterBox> boxes_;
    const EpipolarPlane* plane_ = nullptr;
    double shift_ = 0, z0_ = 0;
    std::uint32_t row_ = 0;  // counted from 1
    std::size_t lines_ = 0;  // so many CellColumns for each box
    std::vector<CellColumns, CacheLineAllocator<CellColumns>> columns_;
    std::vector<Known> known_;
};

/// Whether all samples that may see into the box lie in cells whose farthest sample is in front of it. The twins say
/// the same.
bool cells_hide_plain(const EpipolarPlane& plane, const SeenBox& box);
bool cells_hide(const EpipolarPlane& plane, const SeenBox& box);

/// How far the samples of an epipolar plane are already covered, cell by cell: what lies behind that need not be drawn.
class Occlusion {
  public:
    /// Nothing is covered: also in the plane's own cells.
    void clear(const EpipolarPlane& plane);
    /// Takes in what has been drawn by now, the plane too.
    void update(const EpipolarPlane& plane);
    /// Whether every sample of the plane that may see into the box sees something in front of it. Never true of a box
    /// that holds something visible, or just as near as what is seen.
    bool hides(SeenBoxes& boxes, std::size_t box, const EpipolarPlane& plane) const {
        return worth_asking_ && cells_hide(plane, boxes[box]);
    }

  private:
    bool worth_asking_ = false;
};

}  // namespace hogel::render::epi
