#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/core/array.h"
#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_kernels_internal.h"

namespace hogel {

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

/// Where the hogels of a row see the boxes of all clusters, which is the same in all its planes.
struct SeenBoxes {
    std::size_t lines = 0;  ///< so many CellColumns for each
    std::vector<CellColumns, CacheLineAllocator<CellColumns>> columns;
    std::vector<BoxDepth> depths;

    void make_room(std::size_t boxes, const EpipolarPlane& plane);
    SeenBox operator[](std::size_t box) const { return {&columns[box * lines], depths[box]}; }
    /// Asks for what is known of a box before it is needed.
    void prefetch(std::size_t box) const {
        __builtin_prefetch(&columns[box * lines]);
        __builtin_prefetch(&depths[box]);
    }
};

/// Finds that for the hogels and directions of a plane; boxes are moved by (shift, −z0) first. The twins find the same.
void see_boxes_plain(std::span<const ClusterBox> boxes, const EpipolarPlane& plane, double shift, double z0,
                     SeenBoxes& to);
void see_boxes(std::span<const ClusterBox> boxes, const EpipolarPlane& plane, double shift, double z0, SeenBoxes& to);

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
    bool hides(const SeenBox& box, const EpipolarPlane& plane) const { return worth_asking_ && cells_hide(plane, box); }

  private:
    bool worth_asking_ = false;
};

}  // namespace hogel
