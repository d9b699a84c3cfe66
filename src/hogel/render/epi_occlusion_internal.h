#pragma once

#include <cstdint>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_kernels_internal.h"

namespace hogel {

/// A box as the rays of an epipolar plane see it.
struct SeenBox {
    float x_low, x_high, z_low, z_high;
    float margin;           ///< beyond any rounding of the columns that see the box
    std::uint32_t nearest;  ///< ordered bits of a depth in front of all that is in it
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
    /// that holds something visible, or just as near as what is seen. The box is moved by (shift, −z0) first.
    bool hides(const ClusterBox& box, const EpipolarPlane& plane, double shift = 0, double z0 = 0) const;

  private:
    bool worth_asking_ = false;
};

}  // namespace hogel
