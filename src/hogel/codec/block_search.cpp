#include "hogel/codec/block_search_internal.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hogel {
namespace {

// Bits that things cost, as they are taken into account: about what they come to.
constexpr float likeliest_disparity = 0.3f, each_candidate = 1.5f, new_disparity = 14;
constexpr float best_of_all_sides = 0.3f, one_side = 6;
// In squared steps a block, of most levels of the order and of the last one, from which no other hogel inherits:
// a prediction that costs no more is taken without looking further,
constexpr float good_enough_first = 1.5f, good_enough_last = 2;
// one that costs less is not worth looking all around,
constexpr float worth_looking_first = 12, worth_looking_last = 16;
// and no other one is likely to have a smaller error.
constexpr float least_error = 1;
constexpr int times_along_slopes = 2;
constexpr int farthest_look = 16;  // in units of disparity

}  // namespace

BlockSearch::BlockSearch(const TileSetup& setup, const HogelOrder::Hogel& hogel, const Plane& source,
                         const std::vector<Picture>& pictures, std::span<const std::int16_t> estimated, Effort effort)
    : setup_(setup),
      hogel_(hogel),
      source_(source),
      pictures_(pictures),
      estimated_(estimated),
      effort_(effort),
      weights_(hogel, setup.noise, setup.aspect),
      unit_(disparity_unit(hogel)) {
    const float step = setup.step[static_cast<std::size_t>(hogel.level)];
    const bool last = hogel.level + 1 == setup.order.levels();
    worth_ = bit_worth * step * step;
    good_enough_ = (last ? good_enough_last : good_enough_first) * step * step;
    worth_looking_ = (last ? worth_looking_last : worth_looking_first) * step * step;
    least_error_ = least_error * step * step;
}

const BlockSamples& BlockSearch::seen(int disparity, std::uint32_t reference, Shift shift) {
    const SeenAs as{disparity, reference};
    for (std::size_t n = 0; n < seen_count_; ++n)
        if (seen_as_[n] == as) return seen_[n];
    if (seen_count_ == most_seen) seen_count_ = 0;
    BlockSamples& block = seen_[seen_count_];
    seen_as_[seen_count_++] = as;
    fetch_moved(pictures_[hogel_.references[reference].hogel][0], static_cast<int>(x_), static_cast<int>(y_), shift,
                block);
    return block;
}

bool BlockSearch::take_if_better(const BlockSamples& prediction, float bits, int side, int disparity) {
    const float error = squared_difference(prediction, *wanted_), cost = error + worth_ * bits;
    if (!(cost < best_.cost)) return false;
    best_ = {cost, error, static_cast<std::uint8_t>(1 + side), static_cast<std::int16_t>(disparity), &prediction};
    return true;
}

void BlockSearch::try_any_side(int disparity, float bits) {
    if (std::abs(disparity) > most_disparity || !may_win(bits + best_of_all_sides)) return;
    const auto& choice = weights_.choose(disparity, ReferenceWeights::Side::any);
    if (choice.count == 0) return;
    BlockSamples& spare = kept_[best_.prediction == &kept_[0] ? 1 : 0];
    const BlockSamples& first = seen(disparity, choice.reference[0], choice.shift[0]);
    if (choice.count == 2)
        mix_blocks(first, seen(disparity, choice.reference[1], choice.shift[1]), choice.weight[0], choice.weight[1],
                   spare);
    else
        spare = first;
    take_if_better(spare, bits + best_of_all_sides, 0, disparity);
}

void BlockSearch::try_single_sides(int disparity, float bits) {
    if (std::abs(disparity) > most_disparity) return;
    for (int side = 1; side < static_cast<int>(ReferenceWeights::sides); ++side) {
        if (good() || !may_win(bits + one_side)) return;
        const auto& choice = weights_.choose(disparity, static_cast<ReferenceWeights::Side>(side));
        if (choice.count == 0) continue;
        const BlockSamples& view = seen(disparity, choice.reference[0], choice.shift[0]);
        if (!take_if_better(view, bits + one_side, side, disparity)) continue;
        kept_[0] = view;
        best_.prediction = &kept_[0];
    }
}

// A reference shows, where its disparity is wrong, what is wanted moved by a little: Gauss and Newton's step leads from
// the best disparity so far to that with the least squared difference. Of all sides together and of each by itself, as
// what is wanted may be hidden from some.
void BlockSearch::follow_slopes(int likeliest) {
    if (!slopes_known_) {
        const auto reach = static_cast<std::ptrdiff_t>(slope_reach);
        const PlaneWindow window(source_, static_cast<std::ptrdiff_t>(x_) - reach,
                                 static_cast<std::ptrdiff_t>(y_) - reach, slope_window_side, slope_window_side);
        slopes_of_block(window.rows(), window.stride(), slopes_);
        slopes_known_ = true;
    }
    const int from = best_.disparity;
    std::array<AlongSlope, ReferenceWeights::sides> along{};  // the first is the sum of the others
    for (std::size_t side = 1; side < along.size(); ++side) {
        const auto& choice = weights_.choose(from, static_cast<ReferenceWeights::Side>(side));
        if (choice.count == 0) continue;
        const HogelOrder::Reference& reference = hogel_.references[choice.reference[0]];
        const float distance = static_cast<float>(reference.ds) + static_cast<float>(reference.dt) * setup_.aspect;
        const AlongSlope one = along_slope(seen(from, choice.reference[0], choice.shift[0]), *wanted_,
                                           reference.ds != 0 ? slopes_.u : slopes_.v);
        along[side] = {distance * one.difference, distance * distance * one.square};
        along[0].difference += along[side].difference;
        along[0].square += along[side].square;
    }
    for (const AlongSlope& one : along) {
        if (good()) return;
        if (!(one.square > 0)) continue;
        // What is not a candidate is told in units from the likeliest.
        const float target = static_cast<float>(from - likeliest) + shift_unit * one.difference / one.square;
        const float units = std::nearbyint(target / static_cast<float>(unit_));
        if (!(std::abs(units) <= 2 * most_disparity)) continue;
        const int disparity = likeliest + static_cast<int>(units) * unit_;
        if (disparity != from) try_any_side(disparity, new_disparity);
    }
}

// Farther and then nearer around the best so far.
void BlockSearch::look_around(int likeliest) {
    for (int part = farthest_look * unit_; part >= unit_ && !good(); part /= 2)
        for (const int middle = (best_.disparity - likeliest) / unit_ * unit_; const int sign : {-1, 1}) {
            const int disparity = likeliest + middle + sign * part;
            if (!good()) try_any_side(disparity, new_disparity);
            try_single_sides(disparity, new_disparity);
        }
}

const BlockSearch::Found& BlockSearch::run(std::size_t k, const BlockSamples& wanted, const Candidates& candidates) {
    x_ = k % setup_.grid.columns * block_side;
    y_ = k / setup_.grid.columns * block_side;
    wanted_ = &wanted;
    best_ = {};
    seen_count_ = 0;
    slopes_known_ = false;
    if (hogel_.references.empty()) return best_;
    const auto bits_of = [](std::size_t n) { return likeliest_disparity + each_candidate * static_cast<float>(n); };
    for (std::size_t n = 0; n < candidates.count && !good(); ++n) try_any_side(candidates.disparity[n], bits_of(n));
    if (!estimated_.empty() && !good()) try_any_side(estimated_[k], new_disparity);
    for (std::size_t n = 0; n < candidates.count && !good(); ++n) try_single_sides(candidates.disparity[n], bits_of(n));
    const int likeliest = candidates.disparity[0];
    for (int time = 0; time < times_along_slopes && !good() && may_win(new_disparity + best_of_all_sides); ++time) {
        const int before = best_.disparity;
        follow_slopes(likeliest);
        if (best_.disparity == before) break;
        try_single_sides(best_.disparity, new_disparity);
    }
    if (effort_ == Effort::full && best_.cost > worth_looking_) look_around(likeliest);
    return best_;
}

}  // namespace hogel
