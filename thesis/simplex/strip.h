// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/render/span.h"
#include "thesis/simplex/product_paths.h"
#include "thesis/simplex/slice.h"
#include "thesis/simplex/volume.h"

namespace hogel::simplex {

/// N-simplices that share corners, by indices into the list of their corners. Source: [K] 7.2.2.
template <std::size_t N>
struct Strip {
    using Corners = std::array<std::uint16_t, N + 1>;

    std::vector<ProjectedPoint> points;
    std::vector<Corners> simplices;

    void clear() {
        points.clear();
        simplices.clear();
    }
};

/// Lists each corner of some simplices once, and orders the simplices so that consecutive ones share all corners but
/// one wherever possible. Returns the number of strips, the maximal sequences with this property: two for the six
/// simplices of a (2,2)-simploid.
std::size_t into_strips(std::span<const Simplex<4>> simplices, Strip<4>& strip);

/// Strip that is sliced at rising values of one coordinate. The intersection of an edge with the plane is computed once
/// for all simplices that share the edge.
template <std::size_t N>
class SlicedStrip {
  public:
    void sort(const Strip<N>& strip, std::size_t axis) {
        axis_ = axis;
        const std::size_t count = strip.points.size();
        order_.resize(count);
        for (std::size_t i = 0; i < count; ++i) order_[i] = static_cast<std::uint16_t>(i);
        std::ranges::sort(order_, [&](std::uint16_t a, std::uint16_t b) {
            return is_before(strip.points[a], strip.points[b], axis);
        });
        points_.resize(count);
        rank_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            points_[i] = strip.points[order_[i]];
            rank_[order_[i]] = static_cast<std::uint16_t>(i);
        }
        simplices_ = strip.simplices;
        for (auto& corners : simplices_) {
            for (std::uint16_t& corner : corners) corner = rank_[corner];
            std::ranges::sort(corners);
        }
        below_ = 0;
        if (crossings_.size() < count * count) crossings_.resize(count * count);
    }

    /// Returns the samples, of 0 to n − 1, at which the strip has slices.
    render::Span samples(std::size_t n) const { return samples_cut(points_.front()[axis_], points_.back()[axis_], n); }

    /// Replaces `out` by the slice at a value; values must rise. Source: [K] 5.6.2, as slice().
    void slice(double value, Strip<N - 1>& out) {
        out.clear();
        ++slice_;
        while (below_ < points_.size() && points_[below_][axis_] < value) ++below_;
        for (const auto& corners : simplices_) {
            std::size_t below = 0;
            while (below <= N && corners[below] < below_) ++below;
            if (below == 0 || below > N) continue;
            for (const auto& path : product_paths<N>(below - 1)) {
                auto& piece = out.simplices.emplace_back();
                for (std::size_t k = 0; k < N; ++k)
                    piece[k] = crossing(corners[path[k].first], corners[below + path[k].second], value, out.points);
            }
        }
    }

  private:
    std::uint16_t crossing(std::size_t a, std::size_t b, double value, std::vector<ProjectedPoint>& points) {
        Crossing& known = crossings_[a * points_.size() + b];
        if (known.slice != slice_) {
            known = {slice_, static_cast<std::uint16_t>(points.size())};
            points.push_back(point_between(points_[a], points_[b], axis_, value));
        }
        return known.point;
    }

    struct Crossing {
        std::uint64_t slice = 0;  // index of its slice
        std::uint16_t point = 0;
    };

    std::size_t axis_ = 0, below_ = 0;
    std::vector<ProjectedPoint> points_;  // sorted
    std::vector<typename Strip<N>::Corners> simplices_;
    std::vector<std::uint16_t> order_, rank_;
    std::vector<Crossing> crossings_;  // [lower point][upper point]
    std::uint64_t slice_ = 0;
};

/// Slices the simplices of one volume together, first at each V, then at each U.
class StripSlices {
  public:
    /// For each column and row of directions, whether hogels may see the triangle in it; see SeenDirections.
    struct Seen {
        std::span<const std::uint8_t> v, u;
    };

    /// Calls use(v, u, Strip<2>) for each direction in the volume in which hogels may see the triangle.
    /// Returns the number of slices of single simplices.
    template <class Use>
    std::size_t for_each(std::span<const Simplex<4>> simplices, const Seen& seen, const Use& use) {
        if (simplices.empty()) return 0;
        std::size_t cuts = 0;
        into_strips(simplices, volume_);
        at_every_v_.sort(volume_, axis::v);
        const render::Span rows = at_every_v_.samples(seen.v.size());
        for (std::size_t v = rows.first; v < rows.end; ++v) {
            if (seen.v[v] == 0) continue;
            at_every_v_.slice(static_cast<double>(v), at_v_);
            cuts += at_v_.simplices.size();
            if (at_v_.simplices.empty()) continue;
            at_every_u_.sort(at_v_, axis::u);
            const render::Span columns = at_every_u_.samples(seen.u.size());
            for (std::size_t u = columns.first; u < columns.end; ++u) {
                if (seen.u[u] == 0) continue;
                at_every_u_.slice(static_cast<double>(u), at_uv_);
                cuts += at_uv_.simplices.size();
                if (!at_uv_.simplices.empty()) use(v, u, at_uv_);
            }
        }
        return cuts;
    }

  private:
    Strip<4> volume_;
    Strip<3> at_v_;
    Strip<2> at_uv_;
    SlicedStrip<4> at_every_v_;
    SlicedStrip<3> at_every_u_;
};

/// Rows and columns of hogels covered by the triangles of a convex slice, as SliceInHogels.
class StripInHogels {
  public:
    explicit StripInHogels(const Strip<2>& slice);

    render::Span rows(std::size_t nt) const;
    render::Span columns(std::size_t row, std::size_t ns) const;

  private:
    const Strip<2>& slice_;
    std::vector<std::array<double, 2>>& st_;  // s and t of every point
};

}  // namespace hogel::simplex
