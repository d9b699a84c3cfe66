// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/block_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hogel::codec::encode {

using namespace format;

namespace {

// Bits that things cost, as they are taken into account: about what they come to.
constexpr float likeliest_disparity = 0.3f, other_candidate = 2, each_candidate = 0.7f, new_disparity = 14;
constexpr float best_of_all_sides = 0.3f, one_side = 7;
// In squared steps a block, of most levels of the order and of the last one, from which no other hogel inherits:
// a prediction that costs no more is taken without looking further,
constexpr float good_enough_first = 1.5f, good_enough_last = 2;
// one that costs less is not worth looking farther,
constexpr float worth_looking_first = 12, worth_looking_last = 16;
// and no other one is likely to have a smaller error.
constexpr float min_error = 1;
constexpr int times_along_slopes = 2;
constexpr std::size_t max_nearby = 3;
constexpr int farthest_look = 4;  // in units of disparity

}  // namespace

BlockSearch::BlockSearch(const TileSetup& setup, const HogelOrder::Hogel& hogel, const Plane& source, SeenBlocks& seen,
                         ReferenceWeights& weights, const Known& known)
    : setup_(setup),
      hogel_(hogel),
      source_(source),
      seen_(seen),
      weights_(weights),
      known_(known),
      unit_(disparity_unit(hogel)) {
    const float step = setup.step[static_cast<std::size_t>(hogel.level)];
    const bool last = hogel.level + 1 == setup.order.levels();
    worth_ = bit_worth * step * step;
    good_enough_ = (last ? good_enough_last : good_enough_first) * step * step;
    worth_looking_ = (last ? worth_looking_last : worth_looking_first) * step * step;
    min_error_ = min_error * step * step;
}

// Whether a prediction, whose error this is, is the best so far; then it is noted.
bool BlockSearch::take_if_better(const BlockSamples& prediction, float error, float bits, int side, int disparity) {
    const float cost = error + worth_ * bits;
    if (!(cost < best_.cost)) return false;
    best_ = {cost, error, static_cast<std::uint8_t>(1 + side), static_cast<std::int16_t>(disparity), &prediction};
    return true;
}

void BlockSearch::try_any_side(int disparity, float bits) {
    if (std::abs(disparity) > max_disparity || !may_win(bits + best_of_all_sides)) return;
    const auto& choice = weights_.choose(disparity, ReferenceWeights::Side::any);
    if (choice.count == 0) return;
    BlockSamples& spare = kept_[best_.prediction == &kept_[0] ? 1 : 0];
    const BlockSamples& first = seen_.by(disparity, choice.reference[0], choice.shift[0]);
    if (choice.count == 2) {
        const BlockSamples& second = seen_.by(disparity, choice.reference[1], choice.shift[1]);
        const float error = mix_and_compare(first, second, choice.weight[0], choice.weight[1], *wanted_, spare);
        take_if_better(spare, error, bits + best_of_all_sides, 0, disparity);
    } else {
        const float error = squared_difference(first, *wanted_);
        if (take_if_better(spare, error, bits + best_of_all_sides, 0, disparity)) spare = first;
    }
}

void BlockSearch::try_single_sides(int disparity, float bits) {
    if (std::abs(disparity) > max_disparity) return;
    for (int side = 1; side < static_cast<int>(ReferenceWeights::sides); ++side) {
        if (good() || !may_win(bits + one_side)) return;
        const auto& choice = weights_.choose(disparity, static_cast<ReferenceWeights::Side>(side));
        if (choice.count == 0) continue;
        const BlockSamples& view = seen_.by(disparity, choice.reference[0], choice.shift[0]);
        const float error = squared_difference(view, *wanted_);
        if (!take_if_better(kept_[0], error, bits + one_side, side, disparity)) continue;
        kept_[0] = view;
    }
}

int BlockSearch::told_as(float disparity) const {
    const float away = disparity - static_cast<float>(likeliest_);
    const float units = std::clamp<float>(std::abs(away) / static_cast<float>(unit_) + 0.5f, 0, 2 * max_disparity);
    return likeliest_ + static_cast<int>(units) * (away < 0 ? -unit_ : unit_);
}

// A reference shows, where its disparity is wrong, what is wanted moved by a little: Gauss and Newton's step leads from
// the best disparity so far to that with the least squared difference from all sides together.
void BlockSearch::follow_slopes() {
    if (!slopes_known_) {
        const auto reach = static_cast<std::ptrdiff_t>(slope_reach);
        const PlaneWindow window(source_, static_cast<std::ptrdiff_t>(x_) - reach,
                                 static_cast<std::ptrdiff_t>(y_) - reach, slope_window_side, slope_window_side);
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
        const AlongSlope one = along_slope(seen_.by(from, choice.reference[0], choice.shift[0]), *wanted_,
                                           reference.ds != 0 ? slopes_.u : slopes_.v);
        sum.difference += distance * one.difference;
        sum.square += distance * distance * one.square;
    }
    if (!(sum.square > 0)) return;
    const int disparity = told_as(static_cast<float>(from) + shift_unit * sum.difference / sum.square);
    if (disparity != from) try_any_side(disparity, new_disparity);
}

// The disparities of surfaces around the block, as far as they are known: where one ends, another begins.
void BlockSearch::try_nearby(std::size_t k, const Candidates& candidates) {
    std::array<int, Candidates{}.disparity.size() + max_nearby> tried;
    std::copy_n(candidates.disparity.begin(), candidates.count, tried.begin());
    std::size_t count = candidates.count;
    const auto enough = [&] { return count == candidates.count + max_nearby || !(best_.cost > worth_looking_); };
    const auto try_one = [&](int disparity) {
        for (std::size_t n = 0; n < count; ++n)
            if (std::abs(tried[n] - disparity) <= unit_) return;
        if (enough()) return;
        tried[count++] = disparity;
        const int told = told_as(static_cast<float>(disparity));
        try_any_side(told, new_disparity);
        try_single_sides(told, new_disparity);
    };
    const auto try_moved = [&](std::size_t n) {
        if (!known_.moved.empty() && known_.moved[n]) try_one(known_.moved[n]->disparity);
    };
    const auto try_beside = [&](std::size_t n) {
        if (!known_.beside) return;
        const Block& block = (*known_.beside)[n];
        try_one(block.disparity);
        if (block.mode == parted) try_one(block.disparity_beyond);
    };
    const std::size_t column = k % setup_.grid.columns, row = k / setup_.grid.columns;
    const auto each = [&](std::span<const std::array<int, 2>> places, auto&& use) {
        for (const auto& [right, down] : places) {
            if (enough()) return;
            const std::size_t c = column + static_cast<std::size_t>(right), r = row + static_cast<std::size_t>(down);
            if (c < setup_.grid.columns && r < setup_.grid.rows) use(r * setup_.grid.columns + c);
        }
    };
    constexpr std::array<std::array<int, 2>, 5> straight{{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    constexpr std::array<std::array<int, 2>, 4> across{{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
    each(straight, try_moved);
    each(straight, try_beside);
    each(across, try_moved);
    each(across, try_beside);
}

bool BlockSearch::look_around() {
    const float before = best_.cost;
    for (int part = farthest_look * unit_; part >= unit_ && !good(); part /= 2)
        for (const int middle = (best_.disparity - likeliest_) / unit_ * unit_; const int sign : {-1, 1}) {
            const int disparity = likeliest_ + middle + sign * part;
            if (!good()) try_any_side(disparity, new_disparity);
            try_single_sides(disparity, new_disparity);
        }
    return best_.cost < before;
}

const BlockSearch::Found& BlockSearch::run(std::size_t k, const BlockSamples& wanted, const Candidates& candidates) {
    x_ = k % setup_.grid.columns * block_side;
    y_ = k / setup_.grid.columns * block_side;
    seen_.go_to(x_, y_);
    wanted_ = &wanted;
    likeliest_ = candidates.disparity[0];
    best_ = {};
    slopes_known_ = false;
    if (hogel_.references.empty()) return best_;
    const auto bits_of = [](std::size_t n) {
        return n == 0 ? likeliest_disparity : other_candidate + each_candidate * static_cast<float>(n);
    };
    for (std::size_t n = 0; n < candidates.count && !good(); ++n) try_any_side(candidates.disparity[n], bits_of(n));
    if (!known_.estimated.empty() && !good())
        try_any_side(told_as(static_cast<float>(known_.estimated[k])), new_disparity);
    for (std::size_t n = 0; n < candidates.count && !good(); ++n) try_single_sides(candidates.disparity[n], bits_of(n));
    for (int time = 0; time < times_along_slopes && !good() && may_win(new_disparity + best_of_all_sides); ++time) {
        const int before = best_.disparity;
        follow_slopes();
        if (best_.disparity == before) break;
        try_single_sides(best_.disparity, new_disparity);
    }
    try_nearby(k, candidates);
    return best_;
}

}  // namespace hogel::codec::encode
