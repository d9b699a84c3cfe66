// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/render/epi/clusters.h"
#include "hogel/render/epi/kernels.h"
#include "hogel/render/epi/setup.h"
#include "hogel/render/epi/shaded_spans.h"
#include "hogel/shading.h"

namespace hogel::render::epi {

/// The source of radiance of each triangle of a scene, determined once for all planes.
struct RadianceTable {
    /// Whether spans are shaded between knots (ShadedSpans), because some do not interpolate radiance between their
    /// ends.
    bool uses_knots;
    std::vector<RadianceFrom> from;  ///< by slot of the clusters; empty unless `uses_knots`
    SpanValues background;

    /// @param channels  of the light field: with one, the background's first value is its luminance
    RadianceTable(const ShadedScene& scene, const TriangleClusters& clusters, std::size_t channels);
};

/// The spans of one epipolar plane, set up from the triangles that it crosses. They are numbered in the order in which
/// they are added; number 0 is the background.
class PlaneSpans {
  public:
    /// All arguments must outlive this object.
    PlaneSpans(const ShadedScene& scene, const TriangleClusters& clusters, const RadianceTable& table);

    /// Begins a plane: removes all spans except the background.
    void clear();
    /// Sets up the spans of the triangles in these slots of the clusters.
    void add(std::span<const std::uint32_t> slots, const CutPlane& plane);

    std::size_t count() const { return count_; }
    /// The spans from number `first` on.
    std::span<const EpiSpan> from(std::size_t first) const { return std::span(spans_).subspan(first, count_ - first); }
    std::span<const SpanValues> values() const { return std::span(values_).first(count_); }

    /// RadianceTable::uses_knots; the members below are valid only with it.
    bool uses_knots() const { return table_.uses_knots; }
    const SpanOrigin* origins() const { return origins_.data(); }
    ShadedSpans& shaded() { return shaded_; }

  private:
    void reserve(std::size_t count);

    const ShadedScene& scene_;
    const TriangleClusters& clusters_;
    const RadianceTable& table_;
    std::size_t count_ = 0;  // number of elements in use of the arrays below
    std::vector<EpiSpan> spans_;
    std::vector<SpanValues, CacheLineAllocator<SpanValues>> values_;
    std::vector<SpanOrigin> origins_;
    ShadedSpans shaded_;
};

}  // namespace hogel::render::epi
