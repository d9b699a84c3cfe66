#pragma once

#include <cstdint>
#include <vector>

#include "hogel/render/epi_clusters_internal.h"
#include "hogel/render/epi_kernels_internal.h"

namespace hogel {

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
    std::vector<std::uint32_t> cells_;
    bool worth_asking_ = false;
};

}  // namespace hogel
