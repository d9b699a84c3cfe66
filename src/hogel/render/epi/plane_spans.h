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

/// Source of radiance of each triangle of a scene, determined once for all planes.
struct RadianceTable {
    /// Whether some spans do not interpolate radiance between their ends and are shaded between knots (ShadedSpans).
    bool uses_knots;
    std::vector<RadianceFrom> from;  ///< by slot of the clusters; empty unless `uses_knots`
    SpanValues background;

    /// @param channels  number of channels of the light field: with one, the background's first value is its luminance
    RadianceTable(const ShadedScene& scene, const TriangleClusters& clusters, std::size_t channels);
};

/// Spans of one epipolar plane, numbered in the order of addition; number 0 is the background.
class PlaneSpans {
  public:
    /// All arguments must outlive this object.
    PlaneSpans(const ShadedScene& scene, const TriangleClusters& clusters, const RadianceTable& table);

    /// Begins a plane: removes all spans except the background.
    void clear();
    /// Sets up the spans of the triangles in these slots of the clusters.
    void add(std::span<const std::uint32_t> slots, const CutPlane& plane);

    std::size_t count() const { return count_; }
    /// Returns the spans with numbers `first` and above.
    std::span<const EpiSpan> from(std::size_t first) const { return std::span(spans_).subspan(first, count_ - first); }
    std::span<const SpanValues> values() const { return std::span(values_).first(count_); }

    /// Returns RadianceTable::uses_knots. The members below are valid only if it is true.
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
