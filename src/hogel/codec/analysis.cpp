#include "hogel/codec/analysis_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hogel/codec/part_search_internal.h"

namespace hogel {
namespace {

// Bits that things cost, as they are taken into account: about what they come to.
constexpr float likeliest_disparity = 0.3f, each_candidate = 1.5f, new_disparity = 14;
constexpr float best_of_all_sides = 0.3f, one_side = 6, within = 12, coded_block = 8, coded_level = 3.5f;
// What is added before rounding down: less than a half, as smaller levels take fewer bits.
constexpr float rounding_within = 0.36f, rounding_across = 0.25f;
// A prediction with less error than this, in squared steps a block, is taken without looking further.
constexpr float good_enough = 1.5f;
// Bits that parts take, and how many more there have to be before they are looked for.
constexpr float in_parts = 14, least_gain_by_parts = 8;
constexpr std::int32_t most_level = 1 << 24;

BlockSamples block_of(const Plane& plane, std::size_t x, std::size_t y) {
    BlockSamples block;
    for (std::size_t r = 0; r < block_side; ++r)
        std::copy_n(&plane.samples[(y + r) * plane.width + x], block_side, &block[r * block_side]);
    return block;
}

// What becomes of a channel of a block.
struct CodedChannel {
    BlockSamples prediction;
    bool any_levels = false;
    Levels levels;
    float cost = 0;  // squared error, and what the bits of the levels are worth
};

// The levels of what a prediction leaves; none where they cost more than they are worth.
void quantise(const BlockSamples& wanted, float step, float rounding, CodedChannel& coded) {
    const float worth = bit_worth * step * step;
    coded.cost = squared_difference(wanted, coded.prediction);
    coded.any_levels = false;
    if (coded.cost <= worth * (coded_block + coded_level)) return;
    BlockSamples residual, coefficients;
    for (std::size_t n = 0; n < block_samples; ++n) residual[n] = wanted[n] - coded.prediction[n];
    transform_block(residual, coefficients);
    float after = 0, bits = coded_block;
    bool any = false;
    const float per_step = 1 / step;
    for (std::size_t k = 0; k < block_samples; ++k) {
        const float size = std::min(std::abs(coefficients[k]) * per_step, static_cast<float>(most_level));
        auto level = static_cast<std::int32_t>(size + rounding);
        const std::size_t frequency = k / block_side + k % block_side;
        if (frequency > 7 && level == 1 && size < 0.9f) level = 0;
        const float error = (size - static_cast<float>(level)) * step;
        after += error * error;
        coded.levels[k] = coefficients[k] < 0 ? -level : level;
        if (level == 0) continue;
        any = true;
        bits += coded_level + 2 * static_cast<float>(std::ilogb(static_cast<float>(level))) +
                0.3f * static_cast<float>(frequency);
    }
    const float cost = after + worth * bits;
    if (!any || cost >= coded.cost) return;
    coded.any_levels = true;
    coded.cost = cost;
}

// The best prediction of a block from other hogels that was found so far, by its first channel.
struct Found {
    float cost = std::numeric_limits<float>::infinity();
    std::uint8_t mode = 0;
    std::int16_t disparity = 0;
};

}  // namespace

std::vector<std::int16_t> estimate_disparities(const TileSetup& setup, const std::vector<Picture>& sources,
                                               std::size_t columns, const HogelOrder::Hogel& hogel) {
    const std::size_t rows = sources.size() / columns;
    const Plane& here = sources[hogel.t * columns + hogel.s][0];
    std::array<std::vector<std::pair<const Plane*, HogelOrder::Reference>>, 2> neighbours;  // along s, along t
    for (const int apart : {-4, -2, -1, 1, 2, 4}) {
        const std::ptrdiff_t s = std::ptrdiff_t(hogel.s) + apart, t = std::ptrdiff_t(hogel.t) + apart;
        if (s >= 0 && s < std::ptrdiff_t(columns))
            neighbours[0].push_back({&sources[hogel.t * columns + std::size_t(s)][0], {0, apart, 0}});
        if (t >= 0 && t < std::ptrdiff_t(rows))
            neighbours[1].push_back({&sources[std::size_t(t) * columns + hogel.s][0], {0, 0, apart}});
    }
    std::vector<std::int16_t> result(setup.grid.count());
    const int width = static_cast<int>(here.width), height = static_cast<int>(here.height);
    for (std::size_t k = 0; k < setup.grid.count(); ++k) {
        const int x = static_cast<int>(k % setup.grid.columns * block_side);
        const int y = static_cast<int>(k / setup.grid.columns * block_side);
        const BlockSamples block = block_of(here, std::size_t(x), std::size_t(y));
        // Of the neighbours along each axis the better half counts: what one side hides the other may show.
        const auto cost = [&](int disparity, bool whole_directions) {
            float sum = 0;
            for (const auto& axis : neighbours) {
                std::array<float, 6> errors;
                errors.fill(std::numeric_limits<float>::infinity());
                for (std::size_t n = 0; n < axis.size(); ++n) {
                    const Shift shift = shift_of(disparity, axis[n].second, setup.aspect);
                    BlockSamples other;
                    if (whole_directions) {
                        const int x0 = x + ((shift.u + 32) >> 6), y0 = y + ((shift.v + 32) >> 6);
                        for (int r = 0; r < int(block_side); ++r) {
                            const float* row =
                                &axis[n].first->samples[std::size_t(std::clamp(y0 + r, 0, height - 1)) * here.width];
                            for (int c = 0; c < int(block_side); ++c)
                                other[std::size_t(r) * block_side + std::size_t(c)] =
                                    row[std::clamp(x0 + c, 0, width - 1)];
                        }
                    } else {
                        fetch_moved(*axis[n].first, x, y, shift, other);
                    }
                    errors[n] = squared_difference(other, block);
                }
                // The smaller half, one by one.
                for (std::size_t n = 0; n < (axis.size() + 1) / 2; ++n) {
                    const auto smallest = std::ranges::min_element(errors);
                    sum += *smallest;
                    *smallest = std::numeric_limits<float>::infinity();
                }
            }
            return sum;
        };
        int best = 0;
        float least = cost(0, true);
        const auto try_one = [&](int disparity, bool whole) {
            const float here_cost = cost(disparity, whole);
            if (here_cost < least) {
                least = here_cost;
                best = disparity;
            }
        };
        // Quarters of a direction near by, whole ones farther off; then finer around the best.
        for (int disparity = shift_unit / 4; disparity <= 4 * shift_unit; disparity += shift_unit / 4)
            for (const int sign : {-1, 1}) try_one(sign * disparity, true);
        for (int disparity = 5 * shift_unit; disparity <= 16 * shift_unit; disparity += shift_unit)
            for (const int sign : {-1, 1}) try_one(sign * disparity, true);
        least = cost(best, false);
        for (int part = 16; part >= 2; part /= 2)
            for (const int middle = best; const int sign : {-1, 1}) try_one(middle + sign * part, false);
        result[k] = static_cast<std::int16_t>(best);
    }
    return result;
}

CodedHogel analyse(const TileSetup& setup, std::size_t hogel, const Picture& source,
                   const std::vector<std::optional<std::int16_t>>& moved, const std::vector<Block>* beside,
                   const std::vector<std::int16_t>& estimated, std::vector<Picture>& pictures) {
    const HogelOrder::Hogel& place = setup.order.hogels()[hogel];
    ReferenceWeights weights(place, setup.noise, setup.aspect);
    const float step = setup.step[static_cast<std::size_t>(place.level)], worth = bit_worth * step * step;
    const bool first = place.references.empty();
    PartSearch parts(place, pictures, weights);
    const int unit = disparity_unit(place);
    Picture picture = setup.blank();
    CodedHogel coded;
    coded.blocks.resize(setup.grid.count());
    for (std::size_t k = 0; k < setup.grid.count(); ++k) {
        const std::size_t x = k % setup.grid.columns * block_side, y = k / setup.grid.columns * block_side;
        const Candidates candidates = candidates_for(k, setup.grid, coded.blocks, moved[k], beside);
        const BlockSamples wanted = block_of(source[0], x, y);
        Found best;
        BlockSamples prediction;
        const auto try_side = [&](int disparity, int side, float bits) {
            const auto& choice = weights.choose(disparity, static_cast<ReferenceWeights::Side>(side));
            if (!predict_across(pictures, place, choice, 0, x, y, prediction)) return;
            const float cost =
                squared_difference(prediction, wanted) + worth * (bits + (side == 0 ? best_of_all_sides : one_side));
            if (cost < best.cost)
                best = {cost, static_cast<std::uint8_t>(1 + side), static_cast<std::int16_t>(disparity)};
        };
        const auto good = [&] { return best.cost < good_enough * step * step; };
        const auto try_disparity = [&](int disparity, float bits) {
            if (std::abs(disparity) > most_disparity) return;
            for (int side = 0; side < static_cast<int>(ReferenceWeights::sides); ++side)
                if (!good()) try_side(disparity, side, bits);
        };
        if (!first) {
            for (std::size_t n = 0; n < candidates.count && !good(); ++n)
                try_disparity(candidates.disparity[n], likeliest_disparity + each_candidate * static_cast<float>(n));
            if (!estimated.empty() && !good()) try_disparity(estimated[k], new_disparity);
            // Others, in units away from the likeliest.
            const int likeliest = candidates.disparity[0];
            for (int part = 16 * unit; part >= unit && !good(); part /= 2)
                for (const int middle = (best.disparity - likeliest) / unit * unit; const int sign : {-1, 1})
                    try_disparity(likeliest + middle + sign * part, new_disparity);
        }
        Block& block = coded.blocks[k];
        block.mode = best.mode;
        block.disparity = best.disparity;
        if (!good()) {
            for (int how = 0; how < within_modes; ++how) {
                predict_within(picture[0], x, y, how, prediction);
                const float cost = squared_difference(prediction, wanted) + worth * (first ? 2 : within);
                if (cost < best.cost) {
                    best.cost = cost;
                    block.mode = 0;
                    block.within = static_cast<std::uint8_t>(how);
                }
            }
            if (block.mode == 0) block.disparity = first && !estimated.empty() ? estimated[k] : candidates.disparity[0];
        }
        CodedChannel channel;
        const auto code_channel = [&](const Block& as, std::size_t c) {
            if (as.mode == 0)
                predict_within(picture[c], x, y, as.within, channel.prediction);
            else
                predict_parts(pictures, place, as, choices_of(as, weights), c, x, y, channel.prediction);
            quantise(c == 0 ? wanted : block_of(source[c], x, y), step,
                     as.mode == 0 ? rounding_within : rounding_across, channel);
        };
        code_channel(block, 0);
        if (!first && channel.cost > worth * (in_parts + least_gain_by_parts)) {
            const auto in_two = parts.run(x, y, wanted, candidates, best.disparity, worth);
            const CodedChannel whole = channel;
            if (in_two) code_channel(*in_two, 0);
            if (in_two && channel.cost + worth * in_parts < whole.cost)
                block = *in_two;
            else
                channel = whole;
        }
        for (std::size_t c = 0; c < setup.grid.channels; ++c) {
            if (c > 0) code_channel(block, c);
            if (channel.any_levels) {
                block.coded = static_cast<std::uint8_t>(block.coded | 1 << c);
                coded.levels.push_back(channel.levels);
            }
            place_block(picture[c], x, y, channel.prediction, channel.any_levels ? &channel.levels : nullptr, step);
        }
    }
    pictures[hogel] = std::move(picture);
    return coded;
}

}  // namespace hogel
