// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/analysis.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "hogel/codec/encode/block_search.h"
#include "hogel/codec/encode/partition_search.h"
#include "hogel/codec/format/pictures.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

// Bits that things cost, as they are taken into account: about what they come to.
constexpr float within = 12, within_first = 1, coded_block = 8, coded_level = 3.5f;
constexpr float other_basis = 3, level_of_samples = 5.5f, level_of_half = 4.5f;  // other than cosines
constexpr float bits_of_within(int how) { return how == 0 ? 0 : how < first_direction ? 2 : 5; }
// What is added before rounding down: less than a half, as smaller levels take fewer bits.
constexpr float rounding_within = 0.36f, rounding_across = 0.2f;
// A block whose disparity is that of the block beside it, with less error than this in squared steps, is looked at no
// further.
constexpr float well_estimated = 1;
// The error, in squared finest steps a block, from which on neighbours do not show the same.
constexpr float max_shared_error = 6.4f;
// Bits that parts take, and how many more there have to be before they are looked for.
constexpr float in_parts = 14, min_gain_by_parts = 16;
constexpr std::int32_t max_level = 1 << 24;

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
    std::uint8_t basis = 0;
    Levels levels;
    float cost = 0;  // squared error, and what the bits of the levels are worth
};

// The levels that stand for a residual in a basis. Returns what they gain in squared steps, less what their bits are
// worth.
float gain_of_levels(const BlockSamples& residual, float step, float rounding, float beyond_level, Basis basis,
                     Levels& levels) {
    BlockSamples coefficients;
    transform_block(basis, residual, coefficients);
    levels = {};
    float gain = 0, bits = coded_block;
    if (!basis.cosines()) bits += other_basis;
    const float bits_of_level = basis.cosines() ? coded_level : basis.samples() ? level_of_samples : level_of_half;
    const float per_step = 1 / step;
    for (std::uint64_t large = large_samples(coefficients, (0.99f - rounding) * step); large != 0; large &= large - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(large));
        const float size = std::min(std::abs(coefficients[k]) * per_step, static_cast<float>(max_level));
        const auto level = static_cast<std::int32_t>(size + rounding);
        if (level == 0) continue;
        const std::size_t frequency = (basis.cosines_v ? k / block_side : 0) + (basis.cosines_u ? k % block_side : 0);
        const float left = size - (static_cast<float>(level) + beyond_level);
        gain += size * size - left * left;
        levels[k] = coefficients[k] < 0 ? -level : level;
        bits += bits_of_level + 2 * static_cast<float>(std::bit_width(static_cast<std::uint32_t>(level)) - 1) +
                0.3f * static_cast<float>(frequency);
    }
    return gain - bit_worth * bits;
}

// The levels of what a prediction leaves, whose sum of squares is `error`; none where they cost more than they are
// worth.
void quantise(const BlockSamples& truth, float error, float step, bool from_within, float beyond_level,
              CodedChannel& coded) {
    const float rounding = from_within ? rounding_within : rounding_across;
    const float worth = bit_worth * step * step;
    coded.cost = error;
    coded.any_levels = false;
    if (error <= worth * (coded_block + coded_level)) return;
    BlockSamples residual;
    mix_blocks(truth, coded.prediction, 1, -1, residual);
    float most = 0;  // squared steps gained, less what bits are worth
    for (std::size_t basis = 0; basis < bases.size(); ++basis) {
        Levels levels;
        const float gain = gain_of_levels(residual, step, rounding, beyond_level, bases[basis], levels);
        if (!(gain > most)) continue;
        most = gain;
        coded.any_levels = true;
        coded.basis = static_cast<std::uint8_t>(basis);
        coded.levels = levels;
    }
    coded.cost = error - most * step * step;
}

}  // namespace

Estimate estimate_disparities(const TileSetup& setup, LightFieldTile& tile, const HogelOrder::Hogel& hogel) {
    const auto picture_at = [&](std::size_t s, std::size_t t) {
        const bool in_tile = setup.grid.channels == 1 && setup.whole_blocks();
        return in_tile ? as_in_tile(tile, setup, s, t) : picture_of(tile, setup, s, t);
    };
    const Picture picture = picture_at(hogel.s, hogel.t);
    const Plane& here = picture[0];
    struct Neighbour {
        HogelOrder::Reference place;
        Picture picture;
    };
    std::array<std::vector<Neighbour>, 2> neighbours;  // along s, along t
    for (const int apart : {-4, 4, -2, 2, -1, 1}) {    // what tells most first
        const std::size_t s = hogel.s + static_cast<std::size_t>(apart), t = hogel.t + static_cast<std::size_t>(apart);
        if (s < tile.range.ns) neighbours[0].push_back({{0, apart, 0}, picture_at(s, hogel.t)});
        if (t < tile.range.nt) neighbours[1].push_back({{0, 0, apart}, picture_at(hogel.s, t)});
    }
    std::size_t counted = 0;
    for (const auto& axis : neighbours) counted += (axis.size() + 1) / 2;
    const float well_known = well_estimated * static_cast<float>(counted) * setup.step[0] * setup.step[0];
    const float not_shared = max_shared_error * static_cast<float>(counted) * setup.step.back() * setup.step.back();
    Estimate estimate;
    std::vector<std::int16_t>& result = estimate.disparities;
    result.resize(setup.grid.count());
    for (std::size_t k = 0; k < setup.grid.count(); ++k) {
        const std::size_t column = k % setup.grid.columns, row = k / setup.grid.columns;
        const int x = static_cast<int>(column * block_side), y = static_cast<int>(row * block_side);
        const BlockSamples block = block_of(here, column * block_side, row * block_side);
        // Of the neighbours along each axis the better half counts: what one side hides the other may show. What cannot
        // become less than `most` need not be known.
        const auto cost = [&](int disparity, bool whole_directions, float most) {
            float sum = 0;
            for (const auto& axis : neighbours) {
                std::array<float, 6> smallest;  // errors, in order
                const std::size_t better = (axis.size() + 1) / 2;
                for (std::size_t n = 0; n < axis.size(); ++n) {
                    const Plane& plane = axis[n].picture[0];
                    const Shift shift = shift_of(disparity, axis[n].place, setup.aspect);
                    float error;
                    if (whole_directions) {
                        const PlaneWindow window(plane, x + ((shift.u + 32) >> 6), y + ((shift.v + 32) >> 6),
                                                 block_side, block_side);
                        error = squared_difference(window.rows(), window.stride(), block);
                    } else {
                        BlockSamples other;
                        fetch_moved(plane, x, y, shift, other);
                        error = squared_difference(other, block);
                    }
                    std::size_t at = n;
                    for (; at > 0 && error < smallest[at - 1]; --at) smallest[at] = smallest[at - 1];
                    smallest[at] = error;
                    // With so many left, as many of the smallest may still come.
                    const std::size_t left = axis.size() - 1 - n;
                    float at_least = sum;
                    for (std::size_t i = 0; i + left < better; ++i) at_least += smallest[i];
                    if (!(at_least < most)) return at_least;
                }
                for (std::size_t i = 0; i < better; ++i) sum += smallest[i];
            }
            return sum;
        };
        constexpr float unknown = std::numeric_limits<float>::infinity();
        int best = 0;
        float least = unknown, not_more = unknown;  // of which something less or equal will be found
        const auto try_one = [&](int disparity, bool whole) {
            const float here_cost = cost(disparity, whole, std::min(least, not_more));
            if (here_cost < least) {
                least = here_cost;
                best = disparity;
            }
        };
        // Most blocks go on with the surface on their left or above.
        if (column > 0) try_one(result[k - 1], false);
        if (row > 0 && !(least < well_known)) try_one(result[k - setup.grid.columns], false);
        int part = 4;
        if (!(least < well_known)) {
            // Quarters of a direction near by, whole ones farther off; then finer around the best.
            const int going_on = best;
            const float of_going_on = least;
            const int quarters = shift_unit / 4, unit = std::abs(best) <= 4 * shift_unit ? quarters : shift_unit;
            const int nearest = (best + unit / 2) / unit * unit;
            if (std::abs(nearest) <= 16 * shift_unit) not_more = std::nextafter(cost(nearest, true, unknown), unknown);
            best = 0;
            least = cost(0, true, not_more);
            for (int disparity = shift_unit / 4; disparity <= 4 * shift_unit; disparity += shift_unit / 4)
                for (const int sign : {-1, 1}) try_one(sign * disparity, true);
            for (int disparity = 5 * shift_unit; disparity <= 16 * shift_unit; disparity += shift_unit)
                for (const int sign : {-1, 1}) try_one(sign * disparity, true);
            not_more = unknown;
            least = cost(best, false, unknown);
            if (of_going_on < least) {
                least = of_going_on;
                best = going_on;
            }
            part = 16;
        }
        for (; part >= 2; part /= 2)
            for (const int middle = best; const int sign : {-1, 1}) try_one(middle + sign * part, false);
        result[k] = static_cast<std::int16_t>(best);
        if (least < not_shared) estimate.shared += (1 - least / not_shared) / static_cast<float>(result.size());
    }
    return estimate;
}

CodedHogel analyse(const TileSetup& setup, std::size_t hogel, const Picture& source,
                   const std::vector<const Block*>& moved, const std::vector<Block>* beside,
                   const std::vector<std::int16_t>& estimated, std::vector<Picture>& pictures) {
    const HogelOrder::Hogel& place = setup.order.hogels()[hogel];
    const float step = setup.step[static_cast<std::size_t>(place.level)], worth = bit_worth * step * step;
    const bool first = place.references.empty();
    Picture& picture = pictures[hogel];
    ReferenceWeights weights(place, setup.noise, setup.aspect);
    SeenBlocks seen(place, pictures);
    PartSearch parts(seen, weights);
    BlockSearch search(setup, place, source[0], seen, weights, {estimated, moved, beside});
    CodedHogel coded;
    coded.blocks.resize(setup.grid.count());
    coded.candidates.reserve(setup.grid.count());
    CodedChannel channel, other;
    for (std::size_t k = 0; k < setup.grid.count(); ++k) {
        const std::size_t x = k % setup.grid.columns * block_side, y = k / setup.grid.columns * block_side;
        const Candidates& candidates =
            coded.candidates.emplace_back(candidates_for(k, setup.grid, coded.blocks, moved[k], beside));
        const BlockSamples wanted = block_of(source[0], x, y);
        const BlockSearch::Found& best = search.run(k, wanted, candidates);
        Block& block = coded.blocks[k];
        block.mode = best.mode;
        block.disparity = best.disparity;
        if (!search.good() && best.cost > worth * (first ? within_first : within)) {
            float least = best.cost;
            for (int how = 0; how < within_modes; ++how) {
                predict_within(picture[0], x, y, how, other.prediction);
                float cost = squared_difference(other.prediction, wanted);
                // All hogels inherit from the first one, so that it is worth trying what becomes of each way.
                if (first) {
                    quantise(wanted, cost, step, true, setup.beyond_level(true), other);
                    cost = other.cost;
                }
                cost += worth * ((first ? within_first : within) + bits_of_within(how));
                if (cost < least) {
                    least = cost;
                    block.mode = 0;
                    block.within = static_cast<std::uint8_t>(how);
                }
            }
            if (block.mode == 0) block.disparity = first && !estimated.empty() ? estimated[k] : candidates.disparity[0];
        }
        const auto code_as = [&](const Block& as, std::size_t c) {
            if (as.mode == 0)
                predict_within(picture[c], x, y, as.within, channel.prediction);
            else
                predict_parts(pictures, place, as, choices_of(as, weights), c, x, y, channel.prediction);
            const BlockSamples truth = c == 0 ? wanted : block_of(source[c], x, y);
            quantise(truth, squared_difference(channel.prediction, truth), step, as.mode == 0,
                     setup.beyond_level(as.mode == 0), channel);
        };
        if (block.mode == 0) {
            code_as(block, 0);
        } else {
            channel.prediction = *best.prediction;
            quantise(wanted, best.error, step, false, setup.beyond_level(false), channel);
        }
        if (!first) {
            const auto bits_of_parts = [](const Block& of) { return of.mode == parted ? in_parts : 0; };
            // `other` shows the block otherwise; what is worth more is taken.
            const auto offer = [&](const Block& otherwise, float error) {
                quantise(wanted, error, step, false, setup.beyond_level(false), other);
                if (!(other.cost + worth * bits_of_parts(otherwise) < channel.cost + worth * bits_of_parts(block)))
                    return;
                block = otherwise;
                std::swap(channel, other);
            };
            const auto offer_parts = [&] {
                parts.add(best.disparity);
                if (const auto in_two = parts.best(other.prediction))
                    offer(*in_two, squared_difference(other.prediction, wanted));
            };
            const float worth_parts = worth * (in_parts + min_gain_by_parts);
            if (channel.cost > worth_parts) {
                parts.begin(wanted, candidates, worth);
                offer_parts();
            }
            if (channel.cost > search.worth_looking() && block.mode != 0 && search.look_around()) {
                Block whole;
                whole.mode = best.mode;
                whole.disparity = best.disparity;
                other.prediction = *best.prediction;
                offer(whole, best.error);
                if (channel.cost > worth_parts) offer_parts();
            }
        }
        for (std::size_t c = 0; c < setup.grid.channels; ++c) {
            if (c > 0) code_as(block, c);
            if (channel.any_levels) {
                block.coded = static_cast<std::uint8_t>(block.coded | 1 << c);
                block.basis[c] = channel.basis;
                coded.levels.push_back(channel.levels);
            }
            place_block(picture[c], x, y, channel.prediction, channel.any_levels ? &channel.levels : nullptr,
                        bases[channel.basis], step, setup.beyond_level(block.mode == 0));
        }
    }
    return coded;
}

}  // namespace hogel::codec::encode
