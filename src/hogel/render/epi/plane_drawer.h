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

/// Determines which span each sample of an epipolar plane sees. Clusters that the hierarchical z occludes are skipped;
/// triangles of the others are prefetched, set up in batches and drawn.
class PlaneDrawer {
  public:
    /// Both arguments must outlive this object.
    PlaneDrawer(const TriangleClusters& clusters, PlaneSpans& spans) : clusters_(clusters), spans_(spans) {}

    /// Begins a row of hogels, whose planes share these samples, `shift` and `z0` (EpipolarFrame::Plane).
    /// @param plane  must outlive the row
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
    // The numbers of the first span that is not drawn and of the first not included in the hierarchical z, and the
    // number of spans after which that is updated.
    std::size_t drawn_ = 1, updated_ = 1, update_interval_ = 0;
};

}  // namespace hogel::render::epi
