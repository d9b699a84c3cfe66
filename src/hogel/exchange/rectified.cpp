// SPDX-License-Identifier: Apache-2.0
// Whether cameras were shifted or turned, by their pictures alone. From a shifted camera to the next, points move along
// the line of the cameras, whatever their depth. A camera that is turned by θ about the other axis sees them at
// x' = x + θ(f + x²/f), y' = y + θ x y/f (Hartley and Zisserman, Multiple View Geometry, 8.4: the infinite homography,
// to first order): the second is a keystone, the same for all depths, and 0 in rectified views.
#include "hogel/exchange/rectified.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hogel/work/parallel.h"

namespace hogel::exchange {
namespace {

constexpr long block = 16, step = 8;                       // side of what is compared, and of the grid of its places
constexpr long max_cross = 6;                              // pixels that are searched across the line of the cameras
constexpr std::size_t cells_across = 24, cells_down = 18;  // in each the block with most texture is compared
constexpr std::size_t min_blocks = 24;
// A block has texture if its gradients along any direction have this mean square.
constexpr double min_gradient = 1.5 / 255;

struct Place {
    long y = 0, x = 0;
};

// The smaller eigenvalue of the mean structure tensor of a block: small where it looks alike along a direction.
double texture_of(View<const float, 2> a, Place at) {
    double xx = 0, xy = 0, yy = 0;
    for (long y = at.y; y < at.y + block - 1; ++y)
        for (long x = at.x; x < at.x + block - 1; ++x) {
            const auto j = static_cast<std::size_t>(y), i = static_cast<std::size_t>(x);
            const double dx = a(j, i + 1) - a(j, i), dy = a(j + 1, i) - a(j, i);
            xx += dx * dx, xy += dx * dy, yy += dy * dy;
        }
    const double mean = 0.5 * (xx + yy);
    return (mean - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy)) / ((block - 1) * (block - 1));
}

// The block with most texture in each cell that has one, at least `margin` pixels from the rim.
std::vector<Place> textured_blocks(View<const float, 2> a, long margin_y, long margin_x) {
    const auto height = static_cast<long>(a.extent(0)), width = static_cast<long>(a.extent(1));
    std::vector<std::optional<Place>> best(cells_across * cells_down);
    work::parallel_for(cells_down, [&](std::size_t row) {
        std::array<double, cells_across> most;
        most.fill(min_gradient * min_gradient);
        for (long y = margin_y; y + block + margin_y <= height; y += step) {
            if (static_cast<std::size_t>(y + block / 2) * cells_down / a.extent(0) != row) continue;
            for (long x = margin_x; x + block + margin_x <= width; x += step) {
                const std::size_t column = static_cast<std::size_t>(x + block / 2) * cells_across / a.extent(1);
                const double texture = texture_of(a, {y, x});
                if (texture > most[column]) most[column] = texture, best[row * cells_across + column] = Place{y, x};
            }
        }
    });
    std::vector<Place> places;
    for (const auto& place : best)
        if (place) places.push_back(*place);
    return places;
}

float squared_difference(View<const float, 2> a, View<const float, 2> b, Place at, long dy, long dx, float enough) {
    float sum = 0;
    for (long y = 0; y < block && sum < enough; ++y) {
        const float* p = &a(static_cast<std::size_t>(at.y + y), static_cast<std::size_t>(at.x));
        const float* q = &b(static_cast<std::size_t>(at.y + y + dy), static_cast<std::size_t>(at.x + dx));
        float row = 0;
        for (long x = 0; x < block; ++x) row += (p[x] - q[x]) * (p[x] - q[x]);
        sum += row;
    }
    return sum;
}

// By how much a block moves across the line of the cameras, below a pixel; nothing where it is not found.
std::optional<double> cross_shift(View<const float, 2> a, View<const float, 2> b, Place at, bool along_y, long reach) {
    const auto difference = [&](long along, long across, float enough) {
        return squared_difference(a, b, at, along_y ? along : across, along_y ? across : along, enough);
    };
    float least = INFINITY;
    long best_along = 0, best_across = 0;
    for (long across = -max_cross; across <= max_cross; ++across)
        for (long along = -reach; along <= reach; ++along)
            if (const float error = difference(along, across, least); error < least)
                least = error, best_along = along, best_across = across;
    if (std::abs(best_across) == max_cross || std::abs(best_along) == reach) return {};
    const double before = difference(best_along, best_across - 1, INFINITY),
                 after = difference(best_along, best_across + 1, INFINITY);
    // At the minimum of the parabola what is left must be small against what a shift by a pixel costs.
    const double bend = before - 2 * static_cast<double>(least) + after;
    if (!(bend > 0) || !(static_cast<double>(least) - (before - after) * (before - after) / (8 * bend) < 0.25 * bend))
        return {};
    return static_cast<double>(best_across) + 0.5 * (before - after) / bend;
}

struct Sample {
    std::array<double, 4> terms;  // 1, along, across, their product
    double shift = 0;
};

// Least squares with weights: the normal equations by elimination. Nothing where they are singular.
std::optional<std::array<double, 4>> weighted_fit(const std::vector<Sample>& samples,
                                                  const std::vector<double>& weights) {
    std::array<std::array<double, 5>, 4> m{};
    for (std::size_t s = 0; s < samples.size(); ++s)
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) m[i][j] += weights[s] * samples[s].terms[i] * samples[s].terms[j];
            m[i][4] += weights[s] * samples[s].terms[i] * samples[s].shift;
        }
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t pivot = i;
        for (std::size_t r = i; r < 4; ++r)
            if (std::abs(m[r][i]) > std::abs(m[pivot][i])) pivot = r;
        if (std::abs(m[pivot][i]) < 1e-9 * static_cast<double>(samples.size())) return {};
        std::swap(m[i], m[pivot]);
        for (std::size_t r = 0; r < 4; ++r) {
            if (r == i) continue;
            const double factor = m[r][i] / m[i][i];
            for (std::size_t j = i; j < 5; ++j) m[r][j] -= factor * m[i][j];
        }
    }
    return std::array{m[0][4] / m[0][0], m[1][4] / m[1][1], m[2][4] / m[2][2], m[3][4] / m[3][3]};
}

double residual(const Sample& sample, const std::array<double, 4>& fit) {
    double sum = sample.shift;
    for (std::size_t i = 0; i < 4; ++i) sum -= fit[i] * sample.terms[i];
    return sum;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// How a pair of views disagrees, and which they are.
struct Pair {
    CrossParallax found;
    std::string first, second;

    // Pixels by which blocks move that were compared; at the corners of the picture there may be none.
    double keystone() const { return found.keystone * found.corner; }
    bool is_keystoned() const {
        constexpr double most = 0.5;  // pixels, as for cameras of transforms.json
        const double blocks = static_cast<double>(std::max<std::size_t>(found.blocks, 1));
        return found.blocks > 0 && std::abs(keystone()) > std::max(most, 8 * found.deviation / std::sqrt(blocks));
    }
    double rest() const {
        return std::abs(found.shift) + std::abs(found.roll) * found.along + std::abs(found.zoom) * found.across;
    }
};

// The views in the middle row, or column, that are compared: neighbours of the middle, as far apart as the search
// reaches.
std::vector<Pair> pairs_of(const ViewSet& set, bool along_y, double parallax) {
    const std::size_t views = along_y ? set.rows : set.columns;
    if (views < 2) return {};
    constexpr double reach = 20, max_apart = 4;
    const double inside = std::clamp(static_cast<double>((views - 1) / 2), 1.0, max_apart);
    const auto apart = static_cast<std::size_t>(std::clamp(std::floor(reach / std::max(parallax, 0.1)), 1.0, inside));
    const std::size_t middle = (views - 1) / 2;
    std::vector<std::pair<std::size_t, std::size_t>> compared;
    if (middle >= apart) compared.emplace_back(middle - apart, middle);
    if (middle + apart < views) compared.emplace_back(middle, middle + apart);
    std::vector<Pair> pairs;
    for (const auto& [from, to] : compared) {
        const auto place = [&](std::size_t i) {
            return along_y ? std::pair(i, (set.columns - 1) / 2) : std::pair((set.rows - 1) / 2, i);
        };
        const auto [r0, c0] = place(from);
        const auto [r1, c1] = place(to);
        const int searched = static_cast<int>(std::min(32.0, std::ceil(parallax * static_cast<double>(apart)) + 3));
        pairs.push_back({cross_parallax(grey_view(set, r0, c0), grey_view(set, r1, c1), along_y, searched),
                         set.pictures->name(r0, c0), set.pictures->name(r1, c1)});
    }
    return pairs;
}

}  // namespace

CrossParallax cross_parallax(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift) {
    const long reach = max_shift, margin_y = along_y ? reach : max_cross, margin_x = along_y ? max_cross : reach;
    const std::vector<Place> places = textured_blocks(a, margin_y, margin_x);
    std::vector<std::optional<double>> shifts(places.size());
    work::parallel_for(places.size(), [&](std::size_t i) { shifts[i] = cross_shift(a, b, places[i], along_y, reach); });
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!shifts[i]) continue;
        const double x = 2 * static_cast<double>(places[i].x + block / 2) / static_cast<double>(a.extent(1)) - 1;
        const double y = 2 * static_cast<double>(places[i].y + block / 2) / static_cast<double>(a.extent(0)) - 1;
        samples.push_back({{1, along_y ? y : x, along_y ? x : y, x * y}, *shifts[i]});
    }
    if (samples.size() < min_blocks) return {};
    // Blocks that were found in a wrong place lose their weight: Tukey's biweight, from all alike.
    std::vector<double> weights(samples.size(), 1);
    std::array<double, 4> fit{};
    double deviation = 0;
    for (int round = 0; round < 8; ++round) {
        const auto next = weighted_fit(samples, weights);
        if (!next) return {};
        fit = *next;
        std::vector<double> sizes;
        for (const Sample& sample : samples) sizes.push_back(std::abs(residual(sample, fit)));
        deviation = median(sizes);
        const double scale = 7 * std::max(deviation, 0.1);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double r = std::min(1.0, sizes[i] / scale);
            weights[i] = (1 - r * r) * (1 - r * r);
        }
    }
    const auto percentile = [&](std::size_t term) {
        std::vector<double> sizes;
        for (const Sample& sample : samples) sizes.push_back(std::abs(sample.terms[term]));
        const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 95 / 100);
        std::ranges::nth_element(sizes, at);
        return *at;
    };
    return {fit[0], fit[1], fit[2], fit[3], deviation, percentile(1), percentile(2), percentile(3), samples.size()};
}

void require_rectified(ViewSet& set, const ParallaxEvidence& evidence) {
    for (const bool along_y : {false, true}) {
        const std::vector<Pair> pairs = pairs_of(set, along_y, along_y ? evidence.down : evidence.across);
        if (pairs.empty()) continue;
        // Cameras that turn evenly have the same keystone from each to the next.
        const auto size = [](const Pair& pair) { return std::abs(pair.keystone()); };
        const Pair &one = pairs.front(), &other = pairs.back();
        if (one.is_keystoned() && other.is_keystoned() && one.keystone() * other.keystone() > 0 &&
            std::max(size(one), size(other)) < 3 * std::min(size(one), size(other)))
            fail_source(
                other.second,
                fmt::format("the cameras are turned against each other (toe-in): against {} it is {} by {:.2g} "
                            "pixels towards the corners, which views of shifted cameras are not; rectify the views",
                            std::filesystem::path(other.first).filename().string(),
                            along_y ? "keystoned sideways" : "keystoned up and down", size(other)));
        const auto worst = std::ranges::max_element(pairs, {}, &Pair::rest);
        constexpr double noticed = 0.5;
        if (worst->found.blocks > 0 && worst->rest() > noticed)
            set.notes.push_back(
                fmt::format("things move {} by up to {:.2g} pixels from {} to {}, which they do not in rectified views",
                            along_y ? "sideways" : "up or down", worst->rest(),
                            std::filesystem::path(worst->first).filename().string(),
                            std::filesystem::path(worst->second).filename().string()));
    }
}

}  // namespace hogel::exchange
