#include "hogel/codec/prediction_internal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogel {
namespace {

// Interpolation at each 64th between two samples: a sinc windowed by a wider sinc (Lanczos), in units of 2^-14 so that
// every machine has the same.
struct Filters {
    std::array<Taps, shift_unit> of;
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
                of[std::size_t(fraction)][k] = static_cast<float>(std::nearbyint(weight[k] / sum * 0x1p14) * 0x1p-14);
        }
    }
};
const Filters filters;

// What interpolation at a fraction adds to the noise of a sample, because samples alias: sin² of it, in units of 2^-14.
struct AliasTable {
    std::array<float, shift_unit> of;
    AliasTable() {
        for (int fraction = 0; fraction < shift_unit; ++fraction) {
            const double sine = std::sin(std::numbers::pi * fraction / shift_unit);
            of[std::size_t(fraction)] = static_cast<float>(std::nearbyint(sine * sine * 0x1p14) * 0x1p-14);
        }
    }
};
const AliasTable alias;

constexpr float noise_weight = 0.03f, distance_weight = 0.003f;

std::size_t fraction_of(int shift) { return static_cast<std::size_t>(shift & (shift_unit - 1)); }

bool lies_on(const HogelOrder::Reference& reference, ReferenceWeights::Side side) {
    switch (side) {
        case ReferenceWeights::Side::any:
            return true;
        case ReferenceWeights::Side::left:
            return reference.ds < 0;
        case ReferenceWeights::Side::right:
            return reference.ds > 0;
        case ReferenceWeights::Side::above:
            return reference.dt < 0;
        case ReferenceWeights::Side::below:
            break;
    }
    return reference.dt > 0;
}

}  // namespace

Shift shift_of(int disparity, const HogelOrder::Reference& reference, float aspect) {
    const double v = std::floor(static_cast<double>(-disparity * reference.dt) * static_cast<double>(aspect) + 0.5);
    return {-disparity * reference.ds, static_cast<int>(std::clamp(v, -1e9, 1e9))};
}

void fetch_moved(const Plane& plane, int x, int y, Shift shift, BlockSamples& block) {
    constexpr int reach = window_side;
    const int width = static_cast<int>(plane.width), height = static_cast<int>(plane.height);
    const int x0 = x + (shift.u >> 6) - int(taps_before), y0 = y + (shift.v >> 6) - int(taps_before);
    const std::size_t at_u = fraction_of(shift.u), at_v = fraction_of(shift.v);
    const Taps *along_u = at_u > 0 ? &filters.of[at_u] : nullptr, *along_v = at_v > 0 ? &filters.of[at_v] : nullptr;
    if (x0 >= 0 && y0 >= 0 && x0 + reach <= width && y0 + reach <= height) {
        const float* rows = &plane.samples[static_cast<std::size_t>(y0) * plane.width + static_cast<std::size_t>(x0)];
        return interpolate_block(rows, plane.width, along_u, along_v, block);
    }
    float window[reach * reach];
    for (int r = 0; r < reach; ++r) {
        const float* row = &plane.samples[static_cast<std::size_t>(std::clamp(y0 + r, 0, height - 1)) * plane.width];
        for (int c = 0; c < reach; ++c) window[r * reach + c] = row[std::clamp(x0 + c, 0, width - 1)];
    }
    interpolate_block(window, window_side, along_u, along_v, block);
}

BlockRange blocks_seen(std::size_t columns, std::size_t rows, std::size_t column, std::size_t row, Shift shift) {
    struct Ends {
        std::size_t first, last;
    };
    // Along one axis; whole directions are taken as they are.
    const auto along = [](std::size_t block, std::size_t count, int moved) {
        const bool interpolated = fraction_of(moved) > 0;
        const auto side = static_cast<std::ptrdiff_t>(block_side), end = static_cast<std::ptrdiff_t>(count) * side;
        const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(block) * side + (moved >> 6);
        const auto block_at = [&](std::ptrdiff_t sample) {
            return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(sample, 0, end - 1) / side);
        };
        const auto before = interpolated ? std::ptrdiff_t(taps_before) : 0;
        const auto after = interpolated ? std::ptrdiff_t(taps - 1 - taps_before) : 0;
        return Ends{block_at(begin - before), block_at(begin + side - 1 + after)};
    };
    const Ends u = along(column, columns, shift.u), v = along(row, rows, shift.v);
    return {u.first, u.last, v.first, v.last};
}

ReferenceWeights::ReferenceWeights(const HogelOrder::Hogel& hogel, std::span<const float> noise, float aspect)
    : hogel_(hogel), aspect_(aspect), kept_(256) {
    for (const HogelOrder::Reference& reference : hogel.references) {
        const auto distance = static_cast<float>(reference.ds * reference.ds + reference.dt * reference.dt);
        fixed_.push_back(noise_weight * noise[reference.hogel] + distance_weight * distance);
    }
}

const ReferenceWeights::Choices& ReferenceWeights::choices_for(int disparity) {
    Kept& kept = kept_[static_cast<std::size_t>(disparity + most_disparity) % kept_.size()];
    if (kept.disparity == disparity) return kept.choices;
    kept = {disparity, {}};
    std::array<std::array<float, 2>, sides> cost{};
    for (std::uint32_t k = 0; k < fixed_.size(); ++k) {
        const HogelOrder::Reference& reference = hogel_.references[k];
        const Shift shift = shift_of(disparity, reference, aspect_);
        const float here = fixed_[k] + alias.of[fraction_of(shift.u)] + alias.of[fraction_of(shift.v)];
        for (std::size_t side = 0; side < sides; ++side) {
            if (!lies_on(reference, static_cast<Side>(side))) continue;
            Choice& choice = kept.choices[side];
            std::uint32_t at = choice.count;
            if (at == (static_cast<Side>(side) == Side::any ? 2u : 1u)) {
                if (!(here < cost[side][at - 1])) continue;
                --at;
            } else {
                ++choice.count;
            }
            for (; at > 0 && here < cost[side][at - 1]; --at) {
                cost[side][at] = cost[side][at - 1];
                choice.reference[at] = choice.reference[at - 1];
                choice.shift[at] = choice.shift[at - 1];
            }
            cost[side][at] = here;
            choice.reference[at] = k;
            choice.shift[at] = shift;
        }
    }
    for (std::size_t side = 0; side < sides; ++side) {
        Choice& choice = kept.choices[side];
        choice.weight[0] = 1;
        if (choice.count < 2) continue;
        // Weights as the inverse of the noise that is expected.
        choice.weight[0] = cost[side][1] / (cost[side][0] + cost[side][1]);
        choice.weight[1] = 1 - choice.weight[0];
    }
    return kept.choices;
}

}  // namespace hogel
