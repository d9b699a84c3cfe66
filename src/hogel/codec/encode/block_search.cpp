// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/block_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "hogel/codec/encode/rate_weight.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

// Estimated bits (docs/decisions/0030-codec-prediction.md).
constexpr float first_candidate = 0.3f, other_candidate = 2, each_candidate = 0.7f, new_disparity = 14;
constexpr float best_of_all_sides = 0.3f, one_side = 7;
// Thresholds from the same page, in squared steps per block, for most layers and for the last layer, from which no
// other hogel is predicted. A prediction that costs less than the first ends the search; one that costs more than the
// second justifies a wider search.
constexpr float good_enough = 1.5f, good_enough_last = 2;
constexpr float costly = 12, costly_last = 16;
// A lower bound on the error that a prediction is likely to have.
constexpr float min_error = 1;
constexpr int max_slope_steps = 2;
constexpr std::size_t max_nearby = 3;
constexpr int max_look_distance = 4;  // units of disparity

}  // namespace

BlockSearch::BlockSearch(const TileSetup& setup, const HogelOrder::Hogel& hogel, const Plane& source,
                         WarpedBlocks& warped, ReferenceWeights& weights, const KnownDisparities& known)
    : setup_(setup),
      hogel_(hogel),
      source_(source),
      warped_(warped),
      weights_(weights),
      known_(known),
      unit_(disparity_unit(hogel)) {
    const float step = setup.step[static_cast<std::size_t>(hogel.layer)];
    const bool is_last_layer = hogel.layer + 1 == setup.order.layers();
    rate_weight_ = lambda * step * step;
    good_enough_ = (is_last_layer ? good_enough_last : good_enough) * step * step;
    wide_search_cost_ = (is_last_layer ? costly_last : costly) * step * step;
    min_error_ = min_error * step * step;
}

// Keeps a prediction if it is the best so far, and returns whether it is.
bool BlockSearch::take_if_better(const BlockSamples& prediction, float error, float bits, int side, int disparity) {
    const float cost = error + rate_weight_ * bits;
    if (!(cost < best_.cost)) return false;
    best_ = {cost, error, static_cast<std::uint8_t>(mode_any + side), static_cast<std::int16_t>(disparity),
             &prediction};
    return true;
}

void BlockSearch::try_any_side(int disparity, float bits) {
    if (std::abs(disparity) > max_disparity || !may_win(bits + best_of_all_sides)) return;
    const auto& choice = weights_.choose(disparity, ReferenceWeights::Side::any);
    if (choice.count == 0) return;
    BlockSamples& spare = predictions_[best_.prediction == &predictions_[0] ? 1 : 0];
    const BlockSamples& first = warped_.get(disparity, choice.reference[0], choice.shift[0]);
    if (choice.count == 2) {
        const BlockSamples& second = warped_.get(disparity, choice.reference[1], choice.shift[1]);
        const float error = mix_and_compare(first, second, choice.weight[0], choice.weight[1], *target_, spare);
        take_if_better(spare, error, bits + best_of_all_sides, 0, disparity);
    } else {
        const float error = squared_difference(first, *target_);
        if (take_if_better(spare, error, bits + best_of_all_sides, 0, disparity)) spare = first;
    }
}

void BlockSearch::try_single_sides(int disparity, float bits) {
    if (std::abs(disparity) > max_disparity) return;
    for (int side = 1; side < static_cast<int>(ReferenceWeights::sides); ++side) {
        if (good() || !may_win(bits + one_side)) return;
        const auto& choice = weights_.choose(disparity, static_cast<ReferenceWeights::Side>(side));
        if (choice.count == 0) continue;
        const BlockSamples& view = warped_.get(disparity, choice.reference[0], choice.shift[0]);
        const float error = squared_difference(view, *target_);
        if (!take_if_better(predictions_[0], error, bits + one_side, side, disparity)) continue;
        predictions_[0] = view;
    }
}

int BlockSearch::codable(float disparity) const {
    const float difference = disparity - static_cast<float>(first_candidate_);
    const float units =
        std::clamp<float>(std::abs(difference) / static_cast<float>(unit_) + 0.5f, 0, 2 * max_disparity);
    return first_candidate_ + static_cast<int>(units) * (difference < 0 ? -unit_ : unit_);
}

// With a small disparity error a reference shows the block slightly shifted. Gauss–Newton steps lead from the best
// disparity so far to the least squared difference, summed over all sides.
void BlockSearch::follow_slopes() {
    if (!slopes_known_) {
        const auto margin = static_cast<std::ptrdiff_t>(slope_reach);
        const PlaneWindow window(source_, static_cast<std::ptrdiff_t>(x_) - margin,
                                 static_cast<std::ptrdiff_t>(y_) - margin, slope_window_side, slope_window_side);
        slopes_of_block(window.rows(), window.stride(), slopes_);
        slopes_known_ = true;
    }
    const int from = best_.disparity;
    AlongSlope sum{};
    for (std::size_t side = 1; side < ReferenceWeights::sides; ++side) {
        const auto& choice = weights_.choose(from, static_cast<ReferenceWeights::Side>(side));
        if (choice.count == 0) continue;
        const HogelOrder::Reference& reference = hogel_.references[choice.reference[0]];
        const float distance = static_cast<float>(reference.ds) + static_cast<float>(reference.dt) * setup_.aspect;
        const AlongSlope along = along_slope(warped_.get(from, choice.reference[0], choice.shift[0]), *target_,
                                             reference.ds != 0 ? slopes_.u : slopes_.v);
        sum.difference += distance * along.difference;
        sum.square += distance * distance * along.square;
    }
    if (!(sum.square > 0)) return;
    const int disparity = codable(static_cast<float>(from) + shift_unit * sum.difference / sum.square);
    if (disparity != from) try_any_side(disparity, new_disparity);
}

// Tries the known disparities of neighbouring blocks, because the surface of one of them may continue here.
void BlockSearch::try_nearby(std::size_t k, const Candidates& candidates) {
    std::array<int, Candidates{}.disparity.size() + max_nearby> tried;
    std::copy_n(candidates.disparity.begin(), candidates.count, tried.begin());
    std::size_t count = candidates.count;
    const auto enough = [&] { return count == candidates.count + max_nearby || !(best_.cost > wide_search_cost_); };
    const auto try_one = [&](int disparity) {
        for (std::size_t n = 0; n < count; ++n)
            if (std::abs(tried[n] - disparity) <= unit_) return;
        if (enough()) return;
        tried[count++] = disparity;
        const int coded = codable(static_cast<float>(disparity));
        try_any_side(coded, new_disparity);
        try_single_sides(coded, new_disparity);
    };
    const auto try_warped = [&](std::size_t n) {
        if (!known_.warped.empty() && known_.warped[n]) try_one(known_.warped[n]->disparity);
    };
    const auto try_context = [&](std::size_t n) {
        if (!known_.context_blocks) return;
        const Block& block = (*known_.context_blocks)[n];
        try_one(block.disparity);
        if (block.mode == mode_partitioned) try_one(block.second_disparity);
    };
    const std::size_t column = k % setup_.grid.columns, row = k / setup_.grid.columns;
    const auto for_each_near = [&](std::span<const std::array<int, 2>> offsets, auto&& use) {
        for (const auto& [right, down] : offsets) {
            if (enough()) return;
            const std::size_t c = column + static_cast<std::size_t>(right), r = row + static_cast<std::size_t>(down);
            if (c < setup_.grid.columns && r < setup_.grid.rows) use(r * setup_.grid.columns + c);
        }
    };
    constexpr std::array<std::array<int, 2>, 5> straight{{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    constexpr std::array<std::array<int, 2>, 4> diagonal{{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
    for_each_near(straight, try_warped);
    for_each_near(straight, try_context);
    for_each_near(diagonal, try_warped);
    for_each_near(diagonal, try_context);
}

bool BlockSearch::look_around() {
    const float previous = best_.cost;
    for (int part = max_look_distance * unit_; part >= unit_ && !good(); part /= 2)
        for (const int middle = (best_.disparity - first_candidate_) / unit_ * unit_; const int sign : {-1, 1}) {
            const int disparity = first_candidate_ + middle + sign * part;
            if (!good()) try_any_side(disparity, new_disparity);
            try_single_sides(disparity, new_disparity);
        }
    return best_.cost < previous;
}

const BlockSearch::Found& BlockSearch::run(std::size_t k, const BlockSamples& target, const Candidates& candidates) {
    x_ = k % setup_.grid.columns * block_side;
    y_ = k / setup_.grid.columns * block_side;
    warped_.go_to(x_, y_);
    target_ = &target;
    first_candidate_ = candidates.disparity[0];
    best_ = {};
    slopes_known_ = false;
    if (hogel_.references.empty()) return best_;
    const auto bits_of = [](std::size_t n) {
        return n == 0 ? first_candidate : other_candidate + each_candidate * static_cast<float>(n);
    };
    for (std::size_t n = 0; n < candidates.count && !good(); ++n) try_any_side(candidates.disparity[n], bits_of(n));
    if (!known_.estimated.empty() && !good())
        try_any_side(codable(static_cast<float>(known_.estimated[k])), new_disparity);
    for (std::size_t n = 0; n < candidates.count && !good(); ++n) try_single_sides(candidates.disparity[n], bits_of(n));
    for (int n = 0; n < max_slope_steps && !good() && may_win(new_disparity + best_of_all_sides); ++n) {
        const int previous = best_.disparity;
        follow_slopes();
        if (best_.disparity == previous) break;
        try_single_sides(best_.disparity, new_disparity);
    }
    try_nearby(k, candidates);
    return best_;
}

}  // namespace hogel::codec::encode
