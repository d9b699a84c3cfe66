// SPDX-License-Identifier: Apache-2.0
// Detects from the pictures whether cameras were shifted or rotated. Between shifted cameras, points move along the
// line of the cameras at any depth. A camera rotated by θ about the perpendicular axis sees them at x' = x + θ(f +
// x²/f), y' = y + θ x y/f (Hartley and Zisserman, Multiple View Geometry, 8.4: the infinite homography, to first
// order). The second is a keystone, independent of depth, and 0 in rectified views.
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

constexpr long block = 16, step = 8;                       // block side, and step of the search grid, pixels
constexpr long max_cross = 6;                              // search range across the line of the cameras, pixels
constexpr std::size_t cells_across = 24, cells_down = 18;  // one block per cell is compared: the most textured
constexpr std::size_t min_blocks = 24;
// Minimum root mean square gradient of a textured block, along every direction.
constexpr double min_gradient = 1.5 / 255;

struct BlockPosition {
    long y = 0, x = 0;
};

// Returns the smaller eigenvalue of the mean structure tensor of a block: small if it is uniform along a direction.
double texture_of(View<const float, 2> a, BlockPosition origin) {
    double xx = 0, xy = 0, yy = 0;
    for (long y = origin.y; y < origin.y + block - 1; ++y)
        for (long x = origin.x; x < origin.x + block - 1; ++x) {
            const auto j = static_cast<std::size_t>(y), i = static_cast<std::size_t>(x);
            const double dx = a(j, i + 1) - a(j, i), dy = a(j + 1, i) - a(j, i);
            xx += dx * dx, xy += dx * dy, yy += dy * dy;
        }
    const double mean = 0.5 * (xx + yy);
    return (mean - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy)) / ((block - 1) * (block - 1));
}

// Returns the most textured block of each cell with texture, at least the margins (pixels) from the edges.
std::vector<BlockPosition> textured_blocks(View<const float, 2> a, long margin_y, long margin_x) {
    const auto height = static_cast<long>(a.extent(0)), width = static_cast<long>(a.extent(1));
    std::vector<std::optional<BlockPosition>> best(cells_across * cells_down);
    work::parallel_for(cells_down, [&](std::size_t row) {
        std::array<double, cells_across> most;
        most.fill(min_gradient * min_gradient);
        for (long y = margin_y; y + block + margin_y <= height; y += step) {
            if (static_cast<std::size_t>(y + block / 2) * cells_down / a.extent(0) != row) continue;
            for (long x = margin_x; x + block + margin_x <= width; x += step) {
                const std::size_t column = static_cast<std::size_t>(x + block / 2) * cells_across / a.extent(1);
                const double texture = texture_of(a, {y, x});
                if (texture > most[column])
                    most[column] = texture, best[row * cells_across + column] = BlockPosition{y, x};
            }
        }
    });
    std::vector<BlockPosition> positions;
    for (const auto& candidate : best)
        if (candidate) positions.push_back(*candidate);
    return positions;
}

float squared_difference(View<const float, 2> a, View<const float, 2> b, BlockPosition origin, long dy, long dx,
                         float enough) {
    float sum = 0;
    for (long y = 0; y < block && sum < enough; ++y) {
        const float* p = &a(static_cast<std::size_t>(origin.y + y), static_cast<std::size_t>(origin.x));
        const float* q = &b(static_cast<std::size_t>(origin.y + y + dy), static_cast<std::size_t>(origin.x + dx));
        float row = 0;
        for (long x = 0; x < block; ++x) row += (p[x] - q[x]) * (p[x] - q[x]);
        sum += row;
    }
    return sum;
}

// Returns the subpixel shift of a block across the line of the cameras; nothing if there is no match.
std::optional<double> cross_shift(View<const float, 2> a, View<const float, 2> b, BlockPosition origin, bool along_y,
                                  long max_along) {
    const auto difference = [&](long along, long across, float enough) {
        return squared_difference(a, b, origin, along_y ? along : across, along_y ? across : along, enough);
    };
    float least = INFINITY;
    long best_along = 0, best_across = 0;
    for (long across = -max_cross; across <= max_cross; ++across)
        for (long along = -max_along; along <= max_along; ++along)
            if (const float error = difference(along, across, least); error < least)
                least = error, best_along = along, best_across = across;
    if (std::abs(best_across) == max_cross || std::abs(best_along) == max_along) return {};
    const double before = difference(best_along, best_across - 1, INFINITY),
                 after = difference(best_along, best_across + 1, INFINITY);
    // The residual at the minimum of the parabola must be small relative to the cost of a shift by one pixel.
    const double bend = before - 2 * static_cast<double>(least) + after;
    if (!(bend > 0) || !(static_cast<double>(least) - (before - after) * (before - after) / (8 * bend) < 0.25 * bend))
        return {};
    return static_cast<double>(best_across) + 0.5 * (before - after) / bend;
}

struct Sample {
    std::array<double, 4> terms;  // 1, along, across, their product
    double shift = 0;
};

// Solves weighted least squares by the normal equations. Returns nothing if they are singular.
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

struct Pair {
    CrossParallax found;
    std::string first, second;

    // Keystone in pixels at the outermost compared blocks; the corners of the picture may have no texture.
    double keystone() const { return found.keystone * found.corner; }
    bool is_keystoned() const {
        constexpr double most = 0.5;  // pixels, as for cameras of transforms.json
        const double blocks = static_cast<double>(std::max<std::size_t>(found.blocks, 1));
        return found.blocks > 0 && std::abs(keystone()) > std::max(most, 8 * found.deviation / std::sqrt(blocks));
    }
    // Movement other than keystone at the outermost blocks, pixels; 0 unless it stands out from the scatter of the
    // blocks. Edges of smooth bodies have no texture across the line of the cameras, and scatter by whole pixels.
    double rest() const {
        constexpr double noticed = 0.5, scatter = 4;
        const double size =
            std::abs(found.shift) + std::abs(found.roll) * found.along + std::abs(found.zoom) * found.across;
        return found.blocks > 0 && size > std::max(noticed, scatter * found.deviation) ? size : 0;
    }
};

// Compares pairs in the middle row or column: the middle view and neighbours as far apart as the search range allows.
std::vector<Pair> pairs_of(const ViewSet& set, bool along_y, double parallax) {
    const std::size_t views = along_y ? set.rows : set.columns;
    if (views < 2) return {};
    constexpr double max_search = 20, max_apart = 4;
    const std::size_t half = (views - 1) / 2;
    const double inside = std::clamp(static_cast<double>(half), 1.0, max_apart);
    const auto apart =
        static_cast<std::size_t>(std::clamp(std::floor(max_search / std::max(parallax, 0.1)), 1.0, inside));
    const std::size_t middle = (views - 1) / 2;
    std::vector<std::pair<std::size_t, std::size_t>> compared;
    if (middle >= apart) compared.emplace_back(middle - apart, middle);
    if (middle + apart < views) compared.emplace_back(middle, middle + apart);
    std::vector<Pair> pairs;
    for (const auto& [from, to] : compared) {
        const auto view_at = [&](std::size_t i) {
            return along_y ? std::pair(i, (set.columns - 1) / 2) : std::pair((set.rows - 1) / 2, i);
        };
        const auto [r0, c0] = view_at(from);
        const auto [r1, c1] = view_at(to);
        const int searched = static_cast<int>(std::min(32.0, std::ceil(parallax * static_cast<double>(apart)) + 3));
        pairs.push_back({cross_parallax(grey_view(set, r0, c0), grey_view(set, r1, c1), along_y, searched),
                         set.pictures->name(r0, c0), set.pictures->name(r1, c1)});
    }
    return pairs;
}

}  // namespace

CrossParallax cross_parallax(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift) {
    const long max_along = max_shift, margin_y = along_y ? max_along : max_cross,
               margin_x = along_y ? max_cross : max_along;
    const std::vector<BlockPosition> blocks = textured_blocks(a, margin_y, margin_x);
    std::vector<std::optional<double>> shifts(blocks.size());
    work::parallel_for(blocks.size(),
                       [&](std::size_t i) { shifts[i] = cross_shift(a, b, blocks[i], along_y, max_along); });
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (!shifts[i]) continue;
        const std::size_t column = blocks[i].x + block / 2, row = blocks[i].y + block / 2;
        const double x = 2 * static_cast<double>(column) / static_cast<double>(a.extent(1)) - 1;
        const double y = 2 * static_cast<double>(row) / static_cast<double>(a.extent(0)) - 1;
        samples.push_back({{1, along_y ? y : x, along_y ? x : y, x * y}, *shifts[i]});
    }
    if (samples.size() < min_blocks) return {};
    // Downweight wrong matches by Tukey's biweight, starting from equal weights.
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
        const auto origin = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 95 / 100);
        std::ranges::nth_element(sizes, origin);
        return *origin;
    };
    return {fit[0], fit[1], fit[2], fit[3], deviation, percentile(1), percentile(2), percentile(3), samples.size()};
}

void require_rectified(ViewSet& set, const ParallaxEvidence& evidence) {
    for (const bool along_y : {false, true}) {
        const std::vector<Pair> pairs = pairs_of(set, along_y, along_y ? evidence.down : evidence.across);
        if (pairs.empty()) continue;
        // Evenly rotated cameras have the same keystone between all neighbours.
        const auto size = [](const Pair& pair) { return std::abs(pair.keystone()); };
        const Pair &first = pairs.front(), &last = pairs.back();
        if (first.is_keystoned() && last.is_keystoned() && first.keystone() * last.keystone() > 0 &&
            std::max(size(first), size(last)) < 3 * std::min(size(first), size(last)))
            fail_source(
                last.second,
                fmt::format("the cameras are turned against each other (toe-in): against {} it is {} by {:.2g} "
                            "pixels towards the corners, which views of shifted cameras are not; rectify the views",
                            std::filesystem::path(last.first).filename().string(),
                            along_y ? "keystoned sideways" : "keystoned up and down", size(last)));
        const auto worst = std::ranges::max_element(pairs, {}, &Pair::rest);
        if (worst->rest() > 0)
            set.notes.push_back(
                fmt::format("the views are not rectified: points move {} by up to {:.2g} pixels from {} to {}",
                            along_y ? "sideways" : "up or down", worst->rest(),
                            std::filesystem::path(worst->first).filename().string(),
                            std::filesystem::path(worst->second).filename().string()));
    }
}

}  // namespace hogel::exchange
