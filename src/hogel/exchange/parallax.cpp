// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/parallax.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "hogel/work/parallel.h"

namespace hogel::exchange {
namespace {

constexpr std::size_t block_side = 16;
// Noise level, standard deviation: a block has texture if a shift of one pixel costs more than this noise.
constexpr double noise = 4.0 / 255;
// Minimum ratio of evidence between two explanations.
constexpr double clear_ratio = 1.5;

double squared_difference(View<const float, 2> a, View<const float, 2> b, std::size_t y0, std::size_t x0, long dy,
                          long dx) {
    double sum = 0;
    for (std::size_t y = 0; y < block_side; ++y) {
        const float* p = &a(y0 + y, x0);
        const float* q = &b(static_cast<std::size_t>(static_cast<long>(y0 + y) + dy),
                            static_cast<std::size_t>(static_cast<long>(x0) + dx));
        float row = 0;
        for (std::size_t x = 0; x < block_side; ++x) row += (p[x] - q[x]) * (p[x] - q[x]);
        sum += row;
    }
    return sum;
}

// Minimum mean product of block motions in two comparisons: a quarter of the blocks, half a pixel in both.
constexpr double enough_movement = 0.25 * 0.25;

// Returns the index of the smallest error, or of a similar minimum nearer to no shift: patterns repeat.
std::size_t nearest_minimum(const std::vector<double>& errors, std::size_t no_shift) {
    const double least = *std::ranges::min_element(errors),
                 enough = 1.25 * least + block_side * block_side / (255.0 * 255.0);
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const bool lowest =
            (i == 0 || errors[i] <= errors[i - 1]) && (i + 1 == errors.size() || errors[i] <= errors[i + 1]);
        const double away = std::abs(static_cast<double>(i) - static_cast<double>(no_shift));
        if (lowest && errors[i] <= enough && away < nearest) best = i, nearest = away;
    }
    return best;
}

BlockMatch match_block(View<const float, 2> a, View<const float, 2> b, std::size_t y0, std::size_t x0, bool along_y,
                       int max_shift) {
    const auto size = static_cast<long>(along_y ? a.extent(0) : a.extent(1));
    const auto begin = static_cast<long>(along_y ? y0 : x0);
    const long low = std::max<long>(-max_shift, -begin),
               high = std::min<long>(max_shift, size - begin - long{block_side});
    std::vector<double> errors;
    for (long shift = low; shift <= high; ++shift)
        errors.push_back(squared_difference(a, b, y0, x0, along_y ? shift : 0, along_y ? 0 : shift));
    const auto best =
        errors.begin() + static_cast<std::ptrdiff_t>(nearest_minimum(errors, static_cast<std::size_t>(-low)));
    const auto index = static_cast<std::size_t>(best - errors.begin());
    BlockMatch match{static_cast<double>(low + static_cast<long>(index)), *best, 0};
    if (index == 0 || index + 1 == errors.size()) return match;
    // Minimum of the parabola through three errors.
    const double before = errors[index - 1], after = errors[index + 1], bend = before - 2 * *best + after;
    if (bend > 0) match.shift += 0.5 * (before - after) / bend;
    match.texture = std::min(before, after) - *best;
    return match;
}

bool has_texture(const BlockMatch& match) { return match.texture > block_side * block_side * noise * noise; }

double percentile98(std::vector<double> values) {
    if (values.empty()) return 0;
    const std::size_t index = std::min(values.size() - 1, values.size() * 98 / 100);
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(index));
    return values[index];
}

double largest(const Array<BlockMatch, 2>& matches, double disparity) {
    std::vector<double> shifts;
    for (const BlockMatch& match : matches.elements())
        if (has_texture(match)) shifts.push_back(std::abs(match.shift + disparity));
    return percentile98(std::move(shifts));
}

// Returns the evidence for equal and for opposite directions in two comparisons of views.
std::pair<double, double> same_and_opposite(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b) {
    double same = 0, opposite = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const BlockMatch &x = a.data()[i], &y = b.data()[i];
        if (!has_texture(x) || !has_texture(y)) continue;
        const double product = x.shift * y.shift;
        (product > 0 ? same : opposite) += std::abs(product);
    }
    return {same, opposite};
}

double total_error(const Array<BlockMatch, 2>& matches) {
    double sum = 0;
    for (const BlockMatch& match : matches.elements()) sum += match.error;
    return sum;
}

}  // namespace

Array<BlockMatch, 2> match_blocks(View<const float, 2> a, View<const float, 2> b, bool along_y, int max_shift) {
    Array<BlockMatch, 2> matches({a.extent(0) / block_side, a.extent(1) / block_side});
    work::parallel_for(matches.extent(0), [&](std::size_t row) {
        for (std::size_t column = 0; column < matches.extent(1); ++column)
            matches(row, column) = match_block(a, b, row * block_side, column * block_side, along_y, max_shift);
    });
    return matches;
}

bool move_oppositely(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b) {
    const auto [same, opposite] = same_and_opposite(a, b);
    return opposite > 4 * same && opposite > enough_movement * static_cast<double>(a.size());
}

bool move_alike(const Array<BlockMatch, 2>& a, const Array<BlockMatch, 2>& b) {
    const auto [same, opposite] = same_and_opposite(a, b);
    return same > 4 * opposite && same > enough_movement * static_cast<double>(a.size()) &&
           total_error(b) < clear_ratio * total_error(a);
}

bool moves_up_and_down(View<const float, 2> a, View<const float, 2> b) {
    return total_error(match_blocks(a, b, false, max_parallax)) >
           clear_ratio * total_error(match_blocks(a, b, true, max_parallax));
}

Array<float, 2> grey_view(const ViewSet& set, std::size_t row, std::size_t column) {
    const std::shared_ptr<const image::Picture> picture = set.pictures->look(row, column);
    Array<float, 2> grey({set.height, set.width});
    std::visit(
        [&](const auto& samples) {
            using T = std::remove_cvref_t<decltype(samples(0, 0, 0))>;
            if (samples.shape() != Shape<3>{set.height, set.width, set.channels})
                fail_source(set.pictures->name(row, column), "its size differs from that of the first view");
            float full = 1;
            if constexpr (std::is_same_v<T, float>) {
                for (const float value : samples.elements()) full = std::isfinite(value) ? std::max(full, value) : full;
            } else {
                full = static_cast<float>(std::numeric_limits<T>::max());
            }
            for (std::size_t i = 0; i < grey.size(); ++i) {
                float sum = 0;
                for (std::size_t c = 0; c < set.channels; ++c)
                    sum += static_cast<float>(samples.data()[i * set.channels + c]);
                grey.data()[i] = sum / (full * static_cast<float>(set.channels));
            }
        },
        picture->samples);
    return grey;
}

ParallaxEvidence parallax_of(const ViewSet& set, double disparity) {
    ParallaxEvidence evidence;
    const std::size_t row = set.rows > 1 ? (set.rows - 2) / 2 : 0, column = set.columns > 1 ? (set.columns - 2) / 2 : 0;
    const Array<float, 2> middle = grey_view(set, row, column);
    Array<BlockMatch, 2> right, below;
    double straight = 0, swapped = 0;
    if (set.columns > 1) {
        const Array<float, 2> next = grey_view(set, row, column + 1);
        right = match_blocks(middle, next, false, max_parallax);
        evidence.across = largest(right, disparity);
        if (set.rows > 1) {
            straight += total_error(right);
            swapped += total_error(match_blocks(middle, next, true, max_parallax));
        }
    }
    if (set.rows > 1) {
        const Array<float, 2> next = grey_view(set, row + 1, column);
        below = match_blocks(middle, next, true, max_parallax);
        evidence.down = largest(below, disparity * set.geometry.spacing_ratio);
        straight += total_error(below);
        swapped += total_error(match_blocks(middle, next, false, max_parallax));
    }
    if (set.columns < 2 || set.rows < 2) return evidence;
    evidence.swapped = swapped < straight;
    // Points nearer than the zero-parallax plane move left from a view to its right neighbour, and up to the view
    // below. With the correct order, both shifts of a block have the same sign.
    const auto [same, opposite] = same_and_opposite(right, below);
    evidence.opposed = opposite > same;
    const auto [less, more] = std::minmax(straight, swapped);
    evidence.certain = more > clear_ratio * less && std::max(same, opposite) > clear_ratio * std::min(same, opposite);
    return evidence;
}

}  // namespace hogel::exchange
