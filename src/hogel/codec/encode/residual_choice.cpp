// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/residual_choice.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hogel/codec/encode/rate_weight.h"
#include "hogel/codec/format/reconstruct.h"

namespace hogel::codec::encode {

using namespace format;

namespace {

// Estimated bits (docs/decisions/0030-codec-prediction.md) of a coded block, of a basis other than cosines, and of
// a level in each basis.
constexpr float coded_block = 8, other_basis = 3;
constexpr float level_of_cosines = 3.5f, level_of_samples = 5.5f, level_of_half = 4.5f;
// Added before rounding down: less than a half, as smaller levels take fewer bits.
constexpr float rounding_intra = 0.36f, rounding_inter = 0.2f;
constexpr std::int32_t max_level = 1 << 24;

// Quantises a residual in a basis. Returns the squared error that the levels remove minus λ times their bits, in
// squared steps.
float gain_of_levels(const BlockSamples& residual, float step, float rounding, float reconstruction_offset, Basis basis,
                     Levels& levels) {
    BlockSamples coefficients;
    transform_block(basis, residual, coefficients);
    levels = {};
    float gain = 0, bits = coded_block;
    if (!basis.cosines()) bits += other_basis;
    const float bits_of_level = basis.cosines() ? level_of_cosines : basis.samples() ? level_of_samples : level_of_half;
    const float per_step = 1 / step;
    for (std::uint64_t large = large_samples(coefficients, (0.99f - rounding) * step); large != 0; large &= large - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(large));
        const float size = std::min(std::abs(coefficients[k]) * per_step, static_cast<float>(max_level));
        const auto level = static_cast<std::int32_t>(size + rounding);
        if (level == 0) continue;
        const std::size_t frequency = (basis.cosines_v ? k / block_side : 0) + (basis.cosines_u ? k % block_side : 0);
        const float left = size - (static_cast<float>(level) + reconstruction_offset);
        gain += size * size - left * left;
        levels[k] = coefficients[k] < 0 ? -level : level;
        bits += bits_of_level + 2 * static_cast<float>(std::bit_width(static_cast<std::uint32_t>(level)) - 1) +
                0.3f * static_cast<float>(frequency);
    }
    return gain - lambda * bits;
}

}  // namespace

void quantise(const BlockSamples& truth, float error, float step, bool intra, float reconstruction_offset,
              CodedChannel& channel) {
    const float rounding = intra ? rounding_intra : rounding_inter;
    const float rate_weight = lambda * step * step;
    channel.cost = error;
    channel.any_levels = false;
    if (error <= rate_weight * (coded_block + level_of_cosines)) return;
    BlockSamples residual;
    mix_blocks(truth, channel.prediction, 1, -1, residual);
    float max_gain = 0;
    for (std::size_t basis = 0; basis < bases.size(); ++basis) {
        Levels levels;
        const float gain = gain_of_levels(residual, step, rounding, reconstruction_offset, bases[basis], levels);
        if (!(gain > max_gain)) continue;
        max_gain = gain;
        channel.any_levels = true;
        channel.basis = static_cast<std::uint8_t>(basis);
        channel.levels = levels;
    }
    channel.cost = error - max_gain * step * step;
}

}  // namespace hogel::codec::encode
