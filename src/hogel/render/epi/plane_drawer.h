// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/crossed.h"
#include "hogel/render/epi/hierarchical_z.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/plane_spans.h"

namespace hogel::render::epi {

/// Determines the visible span of each sample of an epipolar plane. Skips clusters that the hierarchical z occludes;
/// prefetches the triangles of the others, sets them up in batches and draws them.
class PlaneDrawer {
  public:
    /// Both arguments must outlive this object.
    PlaneDrawer(const TriangleClusters& clusters, PlaneSpans& spans) : clusters_(clusters), spans_(spans) {}

    /// Begins a row of hogels, for planes with these samples, `shift` and `z0` (EpipolarFrame::Plane). `plane` must
    /// outlive the row.
    void begin_row(const EpipolarPlane& plane, double shift, double z0);
    /// Sets up the spans of a plane and draws them.
    /// @param plane  empty
    /// @param crossed  clusters in drawing order, preferably front to back
    void draw(const EpipolarPlane& plane, const CutPlane& cut, std::span<const CrossedTriangles> crossed);

  private:
    void prefetch(const CrossedTriangles& crossed);
    void set_up_batch(const CutPlane& cut);
    void draw_new(const EpipolarPlane& plane);
    void update_depths(const EpipolarPlane& plane);

    const TriangleClusters& clusters_;
    PlaneSpans& spans_;
    HierarchicalZ depths_;
    BoxFootprints footprints_;
    std::vector<std::uint32_t> batch_;  // slots of the triangles being prefetched
    // Number of the first span not yet drawn, number of the first span not yet in the hierarchical z, and number of
    // spans between updates of the hierarchical z.
    std::size_t drawn_ = 1, updated_ = 1, update_interval_ = 0;
};

}  // namespace hogel::render::epi
