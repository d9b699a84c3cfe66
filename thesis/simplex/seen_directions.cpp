// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/seen_directions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hogel::simplex {

using namespace render;

namespace {

// Returns the samples of [0, n) from floor(low) to ceil(high); low and high may be far outside.
Span samples_around(double low, double high, std::size_t n) {
    const double last = static_cast<double>(n) - 1;
    // Rounding of quotients by a small ζ.
    const double margin = 1e-3 + 1e-12 * std::max(std::abs(low), std::abs(high));
    if (!(low - margin <= last && high + margin >= 0)) return {};
    return {static_cast<std::size_t>(std::max(std::floor(low - margin), 0.0)),
            static_cast<std::size_t>(std::min(std::ceil(high + margin), last)) + 1};
}

}  // namespace

SeenDirections::SeenDirections(const LightFieldGrid& grid) : grid_(grid) {
    const std::uint8_t all_seen = grid.face() == Face::front ? 0 : 1;
    u_.seen.assign(grid.directions_u, all_seen);
    v_.seen.assign(grid.directions_v, all_seen);
}

bool SeenDirections::find(const DeepTriangle& triangle, const HogelRange& range) {
    if (grid_.face() != Face::front) return true;
    const Hogels columns{grid_.s(static_cast<double>(range.s0)), grid_.pitch, range.ns};
    const Hogels rows{grid_.t(static_cast<double>(range.t0)), -grid_.pitch, range.nt};
    return find(
               triangle, 0, columns, [&](std::size_t k) { return grid_.u(static_cast<double>(k)); },
               [&](double U) { return grid_.column(U); }, u_) &&
           find(
               triangle, 1, rows, [&](std::size_t l) { return grid_.v(static_cast<double>(l)); },
               [&](double V) { return grid_.row(V); }, v_);
}

template <class Direction, class Index>
bool SeenDirections::find(const DeepTriangle& triangle, std::size_t coordinate, const Hogels& hogels,
                          const Direction& direction, const Index& index, Axis& axis) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::fill_n(axis.seen.begin() + static_cast<std::ptrdiff_t>(axis.filled.first), axis.filled.size(), 0);
    double low = infinity, high = -infinity;
    const double last = hogels.first + static_cast<double>(hogels.count - 1) * hogels.step;
    for (const auto& corner : triangle)
        for (const double hogel : {hogels.first, last}) {
            const double position = index((corner[coordinate] - hogel) / corner[2]);
            low = std::min(low, position);
            high = std::max(high, position);
        }
    axis.filled = samples_around(low, high, axis.seen.size());
    bool is_any_seen = false;
    for (std::size_t i = axis.filled.first; i < axis.filled.end; ++i) {
        const double slope = direction(i);
        low = infinity, high = -infinity;
        for (const auto& corner : triangle) {
            const double hogel = (corner[coordinate] - slope * corner[2] - hogels.first) / hogels.step;
            low = std::min(low, hogel);
            high = std::max(high, hogel);
        }
        const bool seen = samples_between(low, high, hogels.count).size() > 0;
        axis.seen[i] = seen ? 1 : 0;
        is_any_seen |= seen;
    }
    return is_any_seen;
}

}  // namespace hogel::simplex
