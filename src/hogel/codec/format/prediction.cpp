// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/format/prediction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogel::codec::format {
namespace {

// Interpolation filters at each 64th between two samples: a sinc windowed by a wider sinc (Lanczos), rounded to
// multiples of 2^-14 so that all machines agree.
struct Filters {
    std::array<Taps, shift_unit> entries;
    Filters() {
        for (int fraction = 0; fraction < shift_unit; ++fraction) {
            std::array<double, taps> weight{};
            double sum = 0;
            for (std::size_t k = 0; k < taps; ++k) {
                const double x = std::numbers::pi * (double(k) - double(taps_before) - fraction / double{shift_unit});
                const double half = double(taps) / 2;
                weight[k] = x == 0 ? 1 : std::sin(x) / x * std::sin(x / half) / (x / half);
                sum += weight[k];
            }
            for (std::size_t k = 0; k < taps; ++k)
                entries[std::size_t(fraction)][k] =
                    static_cast<float>(std::nearbyint(weight[k] / sum * 0x1p14) * 0x1p-14);
        }
    }
};
const Filters filters;

// Aliasing noise added by interpolation at a fraction of a sample: sin² of it, rounded to multiples of 2^-14.
struct AliasTable {
    std::array<float, shift_unit> entries;
    AliasTable() {
        for (int fraction = 0; fraction < shift_unit; ++fraction) {
            const double sine = std::sin(std::numbers::pi * fraction / shift_unit);
            entries[std::size_t(fraction)] = static_cast<float>(std::nearbyint(sine * sine * 0x1p14) * 0x1p-14);
        }
    }
};
const AliasTable alias;

// Weights of quantisation noise and distance in the expected noise, relative to aliasing.
constexpr float noise_weight = 0.03f, distance_weight = 0.003f;

std::size_t fraction_of(int shift) { return static_cast<std::size_t>(shift & (shift_unit - 1)); }

ReferenceWeights::Side side_of(const HogelOrder::Reference& reference) {
    using Side = ReferenceWeights::Side;
    if (reference.ds != 0) return reference.ds < 0 ? Side::left : Side::right;
    return reference.dt < 0 ? Side::above : Side::below;
}

}  // namespace

void PlaneWindow::copy(const Plane& plane, std::ptrdiff_t x, std::ptrdiff_t y, std::size_t columns, std::size_t rows) {
    const auto width = static_cast<std::ptrdiff_t>(plane.width), height = static_cast<std::ptrdiff_t>(plane.height);
    // `first`, `inside`: number of samples of each row before the plane's left border, and before its right border.
    const auto count = static_cast<std::ptrdiff_t>(columns);
    const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(-x, 0, count);
    const std::ptrdiff_t inside = std::clamp<std::ptrdiff_t>(width - x, 0, count);
    float* to = copy_.data();
    const float* previous = nullptr;
    for (std::size_t r = 0; r < rows; ++r, to += window_side) {
        const std::ptrdiff_t row = std::clamp<std::ptrdiff_t>(y + static_cast<std::ptrdiff_t>(r), 0, height - 1);
        const float* from = plane.samples.data() + row * width;
        if (from == previous) {
            std::copy_n(to - window_side, columns, to);
            continue;
        }
        previous = from;
        std::fill(to, to + first, from[0]);
        if (first < inside) std::copy_n(from + (x + first), inside - first, to + first);
        std::fill(to + std::max(first, inside), to + count, from[width - 1]);
    }
    rows_ = copy_.data();
    stride_ = window_side;
}

void fetch_warped(const Plane& plane, int x, int y, Shift shift, BlockSamples& block) {
    struct Axis {
        int first;
        std::size_t count;
        const Taps* weights;
    };
    const auto axis_of = [](int position, int offset) {
        const std::size_t fraction = fraction_of(offset);
        if (fraction == 0) return Axis{position + (offset >> 6), block_side, nullptr};
        return Axis{position + (offset >> 6) - int(taps_before), window_side, &filters.entries[fraction]};
    };
    const Axis u = axis_of(x, shift.u), v = axis_of(y, shift.v);
    const PlaneWindow window(plane, u.first, v.first, u.count, v.count);
    // Prefetches the rows of blocks farther to the right, which will be read soon.
    constexpr std::size_t ahead = 4 * block_side;
    for (std::size_t r = 0; r < v.count; ++r) __builtin_prefetch(window.rows() + r * window.stride() + ahead);
    interpolate_block(window.rows(), window.stride(), u.weights, v.weights, block);
}

BlockRange fetched_blocks(std::size_t columns, std::size_t rows, std::size_t column, std::size_t row, Shift shift) {
    struct Ends {
        std::size_t first, last;
    };
    const auto axis_of = [](std::size_t block, std::size_t count, int offset) {
        const bool interpolated = fraction_of(offset) > 0;
        const auto side = static_cast<std::ptrdiff_t>(block_side), end = static_cast<std::ptrdiff_t>(count) * side;
        const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(block) * side + (offset >> 6);
        const auto block_at = [&](std::ptrdiff_t sample) {
            return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(sample, 0, end - 1) / side);
        };
        const auto samples_before = interpolated ? std::ptrdiff_t(taps_before) : 0;
        const auto samples_after = interpolated ? std::ptrdiff_t(taps - 1 - taps_before) : 0;
        return Ends{block_at(begin - samples_before), block_at(begin + side - 1 + samples_after)};
    };
    const Ends u = axis_of(column, columns, shift.u), v = axis_of(row, rows, shift.v);
    return {u.first, u.last, v.first, v.last};
}

ReferenceWeights::ReferenceWeights(const HogelOrder::Hogel& hogel, std::span<const float> noise, float aspect)
    : hogel_(hogel), aspect_(aspect), cache_(new Cached[cached_choices]) {
    for (std::size_t n = 0; n < cached_choices; ++n) cache_[n].disparity = -max_disparity - 1;
    for (const HogelOrder::Reference& reference : hogel.references) {
        const auto distance = static_cast<float>(reference.ds * reference.ds + reference.dt * reference.dt);
        fixed_.push_back({noise_weight * noise[reference.hogel] + distance_weight * distance, side_of(reference)});
    }
}

const ReferenceWeights::Choices& ReferenceWeights::choices_for(int disparity) {
    Cached& cached = cache_[static_cast<std::size_t>(disparity + max_disparity) % cached_choices];
    if (cached.disparity == disparity) return cached.choices;
    cached.disparity = disparity;
    for (Choice& choice : cached.choices) choice.count = 0;
    std::array<std::array<float, 2>, sides> cost;
    for (std::uint32_t k = 0; k < fixed_.size(); ++k) {
        const Shift shift = shift_of(disparity, hogel_.references[k], aspect_);
        const float noise = fixed_[k].cost + alias.entries[fraction_of(shift.u)] + alias.entries[fraction_of(shift.v)];
        // Keeps the `max_count` references of a side with the least noise; of equal ones the earlier.
        const auto offer = [&](Side side, std::uint32_t max_count) {
            auto& costs = cost[static_cast<std::size_t>(side)];
            Choice& choice = cached.choices[static_cast<std::size_t>(side)];
            std::uint32_t position = choice.count;
            if (position == max_count) {
                if (!(noise < costs[position - 1])) return;
                --position;
            } else {
                ++choice.count;
            }
            for (; position > 0 && noise < costs[position - 1]; --position) {
                costs[position] = costs[position - 1];
                choice.reference[position] = choice.reference[position - 1];
                choice.shift[position] = choice.shift[position - 1];
            }
            costs[position] = noise;
            choice.reference[position] = k;
            choice.shift[position] = shift;
        };
        offer(Side::any, 2);
        offer(fixed_[k].side, 1);
    }
    for (std::size_t side = 0; side < sides; ++side) {
        Choice& choice = cached.choices[side];
        choice.weight[0] = 1;
        if (choice.count < 2) continue;
        // Weights are inversely proportional to the expected noise.
        choice.weight[0] = cost[side][1] / (cost[side][0] + cost[side][1]);
        choice.weight[1] = 1 - choice.weight[0];
    }
    return cached.choices;
}

}  // namespace hogel::codec::format
