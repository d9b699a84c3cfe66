// SPDX-License-Identifier: Apache-2.0
#include "hogel/render/simplex/strip.h"

#include <limits>

#include "hogel/render/simplex/scan.h"

namespace hogel::render::simplex {
namespace {

std::uint16_t index_of(const ProjectedPoint& point, std::vector<ProjectedPoint>& points) {
    const auto index = static_cast<std::size_t>(std::ranges::find(points, point) - points.begin());
    if (index == points.size()) points.push_back(point);
    return static_cast<std::uint16_t>(index);
}

// Whether two simplices have all corners but one in common.
bool share_a_face(const Strip<4>::Corners& a, const Strip<4>::Corners& b) {
    return std::ranges::count_if(a, [&](std::uint16_t corner) { return std::ranges::count(b, corner) > 0; }) == 4;
}

// Buffer for the points of a slice, of which a thread has one at a time.
std::vector<std::array<double, 2>>& points_in_hogels() {
    thread_local std::vector<std::array<double, 2>> points;
    return points;
}

}  // namespace

std::size_t into_strips(std::span<const Simplex<4>> simplices, Strip<4>& strip) {
    strip.clear();
    for (const Simplex<4>& simplex : simplices) {
        auto& corners = strip.simplices.emplace_back();
        for (std::size_t i = 0; i < 5; ++i) corners[i] = index_of(simplex[i], strip.points);
    }
    std::size_t strips = strip.simplices.empty() ? 0 : 1;
    for (std::size_t i = 1; i < strip.simplices.size(); ++i) {
        const auto rest = strip.simplices.begin() + static_cast<std::ptrdiff_t>(i);
        const auto next = std::find_if(rest, strip.simplices.end(),
                                       [&](const auto& other) { return share_a_face(*(rest - 1), other); });
        if (next == strip.simplices.end())
            ++strips;
        else
            std::iter_swap(rest, next);
    }
    return strips;
}

StripInHogels::StripInHogels(const Strip<2>& slice) : slice_(slice), st_(points_in_hogels()) {
    st_.clear();
    for (const ProjectedPoint& point : slice.points) {
        const double depth = 1 / point[axis::q];
        st_.push_back({point[axis::s] * depth, point[axis::t] * depth});
    }
}

Span StripInHogels::rows(std::size_t nt) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& [s, t] : st_) {
        low = std::min(low, t);
        high = std::max(high, t);
    }
    return samples_between(low, high, nt);
}

Span StripInHogels::columns(std::size_t row, std::size_t ns) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto include = [&](double s) {
        low = std::min(low, s);
        high = std::max(high, s);
    };
    const double level = static_cast<double>(row);
    for (const auto& [s, t] : st_)
        if (std::abs(t - level) <= scan_margin) include(s);
    for (const auto& corners : slice_.simplices)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t a = corners[i], b = corners[i == 2 ? 0 : i + 1];
            const double ta = st_[a][1], tb = st_[b][1];
            if ((ta <= level && level <= tb) || (tb <= level && level <= ta))
                include(crossing(slice_.points[a], slice_.points[b], level));
        }
    return samples_between(low, high, ns);
}

}  // namespace hogel::render::simplex
