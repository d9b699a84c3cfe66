// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "thesis/zerotrees/jpeg4d_table.h"

namespace hogel::zerotrees {
namespace {

constexpr double round_up = 0.6;
constexpr double lambda = 0.12;            // in scale² per bit; for fine steps ln 2 / 6 is optimal
constexpr int candidates = 13;             // steps up to 8 times the scale
constexpr std::size_t max_sampled = 4096;  // blocks
constexpr std::size_t max_bits = 31;

// Expected exponent of a frequency: the mean, rounded down, of the exponents of frequencies one lower along an axis.
class Prediction {
  public:
    explicit Prediction(const Exponents& exponents) : exponents_(exponents) {}
    int operator()(const Frequency& frequency) const {
        int sum = 0, count = 0;
        std::size_t step = 1;
        for (std::size_t axis = frequency.size(); axis-- > 0; step *= wavelets::dct_block)
            if (frequency[axis] > 0) {
                sum += exponents_[index_in_block(frequency) - step];
                ++count;
            }
        return count > 0 ? sum / count : 0;
    }

  private:
    const Exponents& exponents_;
};

// Models of a difference from the prediction: whether it is nonzero (context: the same of the previous frequency), its
// sign, and its size in unary.
struct DifferenceModels {
    std::array<coding::BitModel, 2> differs;
    coding::BitModel sign;
    std::array<coding::BitModel, max_exponent + 1> more;
};

double bits_of_difference(int difference) { return difference == 0 ? 0.2 : 4 + std::abs(difference); }

std::size_t bits_of(std::uint32_t magnitude) { return static_cast<std::size_t>(std::bit_width(magnitude)); }

// Returns the stride n of sampled blocks; n > 1 if there are more than max_sampled blocks.
std::size_t stride_of(const Blocks& blocks) { return (blocks.count() + max_sampled - 1) / max_sampled; }

// Estimated cost of a level in bits, by its number of bits: the level's bits plus the mean cost of its tuple and of the
// zeros before it, from the frequencies of tuples with equal steps.
class Costs {
  public:
    Costs(const Blocks& blocks, std::span<const float> values, const Quantisation& uniform) {
        const auto min_magnitudes = min_values(blocks, uniform);
        std::vector<double> counts(Tuple{z_max, max_bits}.symbol() + 1);
        double total = 0;
        SparseLevels levels;
        for (std::size_t number = 0; number < blocks.count(); number += stride_of(blocks)) {
            const Blocks::Block block = blocks[number];
            quantise_block(blocks.kind(block), &values[block.origin], min_magnitudes[block.kind], uniform, levels);
            for_each_tuple(levels, blocks.kind(block).offsets.size(), [&](const Tuple& tuple, std::int32_t) {
                ++counts[tuple.symbol()];
                ++total;
            });
        }
        const double zeros = counts[Tuple{z_max, 0}.symbol()];
        double levels_seen = 0;
        for (int bits = 1; bits <= static_cast<int>(max_bits); ++bits) {
            double count = 0, sum = 0;
            for (int zeros_before = 0; zeros_before <= z_max; ++zeros_before) {
                const double n = counts[Tuple{zeros_before, bits}.symbol()];
                count += n;
                if (n > 0) sum += n * std::log2(total / n);
            }
            levels_seen += count;
            of_bits_[static_cast<std::size_t>(bits)] = bits + (count > 0 ? sum / count : std::log2(total + 1));
        }
        const double for_zeros = zeros > 0 && levels_seen > 0 ? zeros * std::log2(total / zeros) / levels_seen : 0;
        for (double& cost : of_bits_) cost += for_zeros;
    }
    double operator()(std::uint32_t magnitude) const { return of_bits_[bits_of(magnitude)]; }

  private:
    std::array<double, max_bits + 1> of_bits_{};
};

// [frequency of a full block][candidate step]: distortion + λ · bits of its levels.
using Prices = std::vector<std::array<double, candidates>>;

Prices prices(const Blocks& blocks, std::span<const float> values, double scale, const Costs& costs) {
    std::array<double, candidates> steps;
    for (std::size_t e = 0; e < candidates; ++e) steps[e] = scale * std::exp2(static_cast<double>(e) / 4);
    const Quantisation finest = own_quantisation(scale, Exponents(zigzag(blocks.axes()).size(), 0));
    const auto min_magnitudes = min_values(blocks, finest);
    const double price = lambda * scale * scale, part = 1 / static_cast<double>(stride_of(blocks));
    Prices result(finest.steps.size(), std::array<double, candidates>{});
    // Values with level zero for every candidate are skipped, because their distortion is always the same.
    for (std::size_t number = 0; number < blocks.count(); number += stride_of(blocks)) {
        const Blocks::Block block = blocks[number];
        const Blocks::Kind& kind = blocks.kind(block);
        for_each_large(kind, &values[block.origin], min_magnitudes[block.kind], [&](std::size_t entry, float value) {
            const double magnitude = std::abs(value);
            auto& sums = result[kind.full_index[entry]];
            for (std::size_t e = 0; e < candidates; ++e) {
                const auto level = static_cast<std::uint32_t>(magnitude / steps[e] + (1 - round_up));
                const double error = magnitude - level * steps[e];
                sums[e] += (error * error + (level > 0 ? price * costs(level) : 0)) / part;
            }
        });
    }
    return result;
}

}  // namespace

Quantisation own_quantisation(double scale, const Exponents& exponents) {
    Quantisation quantisation{{}, round_up};
    for (const std::uint8_t e : exponents) quantisation.steps.push_back(scale * std::exp2(e / 4.0));
    return quantisation;
}

Exponents choose_exponents(const Blocks& blocks, std::span<const float> values, double scale) {
    Exponents exponents(zigzag(blocks.axes()).size(), 0);
    const Costs costs(blocks, values, own_quantisation(scale, exponents));
    const Prices of = prices(blocks, values, scale, costs);
    const Prediction predict(exponents);
    for (const Frequency& frequency : blocks.frequencies()) {
        const int expected = predict(frequency);
        const std::size_t index = index_in_block(frequency);
        double min_price = std::numeric_limits<double>::infinity();
        for (int e = 0; e < candidates; ++e) {
            const double price =
                of[index][static_cast<std::size_t>(e)] + lambda * scale * scale * bits_of_difference(e - expected);
            if (price >= min_price) continue;
            min_price = price;
            exponents[index] = static_cast<std::uint8_t>(e);
        }
    }
    return exponents;
}

void write_exponents(coding::ArithmeticEncoder& encoder, const Blocks& blocks, const Exponents& exponents) {
    DifferenceModels models;
    const Prediction predict(exponents);
    bool differed = false;
    for (const Frequency& frequency : blocks.frequencies()) {
        const int difference = exponents[index_in_block(frequency)] - predict(frequency);
        encoder.bit(models.differs[differed], difference != 0);
        differed = difference != 0;
        if (!differed) continue;
        encoder.bit(models.sign, difference < 0);
        for (int size = 1; size <= std::abs(difference) && size < max_exponent; ++size)
            encoder.bit(models.more[static_cast<std::size_t>(size)], size < std::abs(difference));
    }
}

bool read_exponents(coding::ArithmeticDecoder& decoder, const Blocks& blocks, Exponents& exponents) {
    exponents.assign(zigzag(blocks.axes()).size(), 0);
    DifferenceModels models;
    const Prediction predict(exponents);
    bool differed = false;
    for (const Frequency& frequency : blocks.frequencies()) {
        int exponent = predict(frequency);
        differed = decoder.bit(models.differs[differed]);
        if (differed) {
            const bool below = decoder.bit(models.sign);
            int size = 1;
            while (size < max_exponent && decoder.bit(models.more[static_cast<std::size_t>(size)])) ++size;
            exponent += below ? -size : size;
        }
        if (decoder.ended() || exponent < 0 || exponent > max_exponent) return false;
        exponents[index_in_block(frequency)] = static_cast<std::uint8_t>(exponent);
    }
    return true;
}

}  // namespace hogel::zerotrees
