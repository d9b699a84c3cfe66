#pragma once

#include <array>
#include <cstddef>

#include "hogel/render/simplex_volume_internal.h"

namespace hogel {

/// Samples this close to an edge, in samples, count as inside while they are looked for: far more than rounding can
/// amount to on the way, and far too little to find a sample twice often. Whether a ray meets the triangle is decided
/// by ObliqueTriangle.
constexpr double scan_margin = 1e-6;

/// A number of columns that follow each other in a row of hogels: first <= s < end.
struct Span {
    std::size_t first = 0, end = 0;
};

/// The whole numbers from `low` to `high` within the margin, of [0, n).
Span samples_between(double low, double high, std::size_t n);

/// A point in (s, t) with the Q of the projected point it was. Source: [K] 5.7.4.
struct HogelPoint {
    double s = 0, t = 0, q = 0;
};

/// Where row t crosses the edge between two projected points that lie on either side of it, or one of them on it.
/// Source: [K] 5.7.4, the equation below (5.7).
double crossing(const ProjectedPoint& a, const ProjectedPoint& b, double t);

/// The rows and columns of hogels that a slice of a projected volume at one U and one V covers.
///
/// [K] calls the edges of the slice curves in (s, t). They are straight: (s, t) = (S, T)/Q is a central projection of
/// (S, T, Q), in which the edges are straight. Only the places between their ends are not spaced evenly.
class SliceInHogels {
  public:
    explicit SliceInHogels(const Simplex<2>& slice);

    Span rows(std::size_t nt) const;
    /// Source: [K] 5.7.4.
    Span columns(std::size_t row, std::size_t ns) const;

  private:
    const Simplex<2>& slice_;
    std::array<double, 3> s_, t_;
};

}  // namespace hogel
