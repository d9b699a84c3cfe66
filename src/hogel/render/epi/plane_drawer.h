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

/// Finds which span each sample of an epipolar plane sees. Clusters that the hierarchical z occludes are skipped.
/// Triangles of the others are prefetched, set up in batches and drawn.
class PlaneDrawer {
  public:
    /// Both arguments have to outlive it.
    PlaneDrawer(const TriangleClusters& clusters, PlaneSpans& spans) : clusters_(clusters), spans_(spans) {}

    /// Begins a row of hogels, whose planes all have these samples, `shift` and `z0` (EpipolarFrame::Plane).
    /// @param plane  has to outlive the row
    void begin_row(const EpipolarPlane& plane, double shift, double z0);
    /// Sets up the spans of a plane and draws them.
    /// @param plane  empty
    /// @param crossed  clusters in the order in which they are drawn, best from front to back
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
    std::vector<std::uint32_t> batch_;  // slots of triangles that are being prefetched
    // Numbers of spans: up to which they are drawn, and are in the hierarchical z; and after how many it is updated.
    std::size_t drawn_ = 1, updated_ = 1, update_interval_ = 0;
};

}  // namespace hogel::render::epi
