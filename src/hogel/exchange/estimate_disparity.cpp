// SPDX-License-Identifier: Apache-2.0
// Plane sweep over candidate disparities. The cost of a pixel is the sum of the smaller half of the differences to the
// surrounding views, because a point that is hidden in some views is visible in the opposite ones.
#include <algorithm>
#include <cmath>

#include "hogel/core/stop_scope.h"
#include "hogel/exchange/disparity.h"
#include "hogel/exchange/parallax.h"
#include "hogel/work/parallel.h"

namespace hogel::exchange {
namespace {

// Step between candidates in pixels, rows per task, and window radius r: windows have 2 r + 1 pixels a side.
constexpr double disparity_step = 0.25;
constexpr std::size_t strip = 48;
constexpr long window = 2;
// Number of views on each side of the middle one.
constexpr long neighbour_range = 2;
// Upper limit of a difference, relative to the full range, which bounds the influence of outliers.
constexpr float max_difference = 0.1f;

struct Neighbour {
    double across = 0, down = 0;
    Array<float, 2> grey;
};

float sample(const Array<float, 2>& grey, double x, double y) {
    const double x_in = std::clamp(x, 0.0, static_cast<double>(grey.extent(1) - 1));
    const double y_in = std::clamp(y, 0.0, static_cast<double>(grey.extent(0) - 1));
    const auto x0 = static_cast<std::size_t>(x_in), y0 = static_cast<std::size_t>(y_in);
    const std::size_t x1 = std::min(x0 + 1, grey.extent(1) - 1), y1 = std::min(y0 + 1, grey.extent(0) - 1);
    const auto fx = static_cast<float>(x_in - static_cast<double>(x0)),
               fy = static_cast<float>(y_in - static_cast<double>(y0));
    const float top = grey(y0, x0) + fx * (grey(y0, x1) - grey(y0, x0));
    const float bottom = grey(y1, x0) + fx * (grey(y1, x1) - grey(y1, x0));
    return top + fy * (bottom - top);
}

std::vector<Neighbour> neighbours(const ViewSet& set, std::size_t row, std::size_t column) {
    std::vector<Neighbour> list;
    for (long k = -neighbour_range; k <= neighbour_range; ++k) {
        const long r = static_cast<long>(row) + k, c = static_cast<long>(column) + k;
        if (k == 0) continue;
        if (c >= 0 && c < static_cast<long>(set.columns))
            list.push_back({static_cast<double>(k), 0, grey_view(set, row, static_cast<std::size_t>(c))});
        if (r >= 0 && r < static_cast<long>(set.rows))
            list.push_back({0, static_cast<double>(k) * set.geometry.spacing_ratio,
                            grey_view(set, static_cast<std::size_t>(r), column)});
    }
    return list;
}

// Computes the cost of a candidate at the rows [first, first + count).
void costs(const Array<float, 2>& middle, const std::vector<Neighbour>& around, double disparity, long first,
           Array<float, 2>& cost) {
    std::vector<float> differences(around.size());
    const std::size_t half = std::max<std::size_t>(1, around.size() / 2);
    for (std::size_t j = 0; j < cost.extent(0); ++j)
        for (std::size_t x = 0; x < cost.extent(1); ++x) {
            const auto y = static_cast<std::size_t>(
                std::clamp(first + static_cast<long>(j), 0L, static_cast<long>(middle.extent(0)) - 1));
            for (std::size_t i = 0; i < around.size(); ++i)
                differences[i] =
                    std::min(max_difference,
                             std::abs(middle(y, x) - sample(around[i].grey,
                                                            static_cast<double>(x) - disparity * around[i].across,
                                                            static_cast<double>(y) - disparity * around[i].down)));
            std::nth_element(differences.begin(), differences.begin() + static_cast<long>(half - 1), differences.end());
            float sum = 0;
            for (std::size_t i = 0; i < half; ++i) sum += differences[i];
            cost(j, x) = sum;
        }
}

// Sums over windows, for the rows with complete windows.
Array<float, 2> windowed(const Array<float, 2>& cost) {
    const std::size_t width = cost.extent(1);
    Array<float, 2> across(cost.shape()), sums({cost.extent(0) - 2 * window, width});
    for (std::size_t y = 0; y < cost.extent(0); ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (long i = -window; i <= window; ++i)
                across(y, x) += cost(y, static_cast<std::size_t>(
                                            std::clamp(static_cast<long>(x) + i, 0L, static_cast<long>(width) - 1)));
    for (std::size_t y = 0; y < sums.extent(0); ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t i = 0; i <= 2 * window; ++i) sums(y, x) += across(y + i, x);
    return sums;
}

void sweep(const Array<float, 2>& middle, const std::vector<Neighbour>& around, double max_disparity, std::size_t first,
           DisparityMap& map) {
    const std::size_t rows = std::min(strip, middle.extent(0) - first), width = middle.extent(1);
    const long most = std::lround(std::ceil(max_disparity / disparity_step));
    Array<float, 2> before, now, least({rows, width}, INFINITY);
    // Candidates in ascending order: when `next` is computed, `now` has both neighbours for the parabola fit.
    Array<float, 2> cost({rows + 2 * window, width});
    for (long k = -most - 1; k <= most + 1; ++k) {
        core::throw_if_stopped();
        costs(middle, around, static_cast<double>(k) * disparity_step, static_cast<long>(first) - window, cost);
        Array<float, 2> next = windowed(cost);
        if (before.size() > 0)
            for (std::size_t i = 0; i < now.size(); ++i) {
                const float value = now.data()[i];
                if (value >= least.data()[i]) continue;
                least.data()[i] = value;
                const float left = before.data()[i], right = next.data()[i], bend = left + right - 2 * value;
                const double beside =
                    bend > 0 ? std::clamp(0.5 * static_cast<double>((left - right) / bend), -0.5, 0.5) : 0;
                map.data()[first * width + i] =
                    static_cast<float>((static_cast<double>(k - 1) + beside) * disparity_step);
            }
        before = std::move(now);
        now = std::move(next);
    }
}

}  // namespace

DisparityMap estimate_disparity(const ViewSet& set, double max_disparity) {
    const std::size_t row = set.rows / 2, column = set.columns / 2;
    const Array<float, 2> middle = grey_view(set, row, column);
    const std::vector<Neighbour> around = neighbours(set, row, column);
    DisparityMap map(middle.shape());
    if (around.empty()) return map;
    work::parallel_for((set.height + strip - 1) / strip,
                       [&](std::size_t i) { sweep(middle, around, max_disparity, i * strip, map); });
    return map;
}

std::shared_ptr<const Disparities> estimated_disparities(const ViewSet& set, double max_disparity, std::size_t kept) {
    std::vector<std::pair<std::pair<std::size_t, std::size_t>, DisparityMap>> known;
    known.push_back({{set.rows / 2, set.columns / 2}, estimate_disparity(set, max_disparity)});
    return std::make_shared<const Disparities>(std::move(known), set.geometry.spacing_ratio, Disparities::estimate,
                                               kept);
}

}  // namespace hogel::exchange
