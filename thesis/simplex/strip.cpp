// SPDX-License-Identifier: Apache-2.0
#include "thesis/simplex/strip.h"

#include "thesis/simplex/scan.h"

namespace hogel::simplex {

using namespace render;

namespace {

std::uint16_t index_of(const ProjectedPoint& point, std::vector<ProjectedPoint>& points) {
    const auto index = static_cast<std::size_t>(std::ranges::find(points, point) - points.begin());
    if (index == points.size()) points.push_back(point);
    return static_cast<std::uint16_t>(index);
}

bool share_a_face(const Strip<4>::Corners& a, const Strip<4>::Corners& b) {
    return std::ranges::count_if(a, [&](std::uint16_t corner) { return std::ranges::count(b, corner) > 0; }) == 4;
}

// Buffer for the points of a slice; a thread handles one slice at a time.
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
    for (const ProjectedPoint& point : slice.points) st_.push_back(place_in_hogels(point));
}

Span StripInHogels::rows(std::size_t nt) const {
    Extent rows;
    for (const auto& [s, t] : st_) rows.include(t);
    return rows.samples(nt);
}

Span StripInHogels::columns(std::size_t row, std::size_t ns) const {
    Extent columns;
    for (const auto& [a, b, c] : slice_.simplices)
        columns.include_row({a, b, c}, slice_.points, st_, static_cast<double>(row));
    return columns.samples(ns);
}

}  // namespace hogel::simplex
