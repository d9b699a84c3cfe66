// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/jpeg4d.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "hogel/coding/arithmetic.h"
#include "hogel/coding/histogram_rule.h"
#include "hogel/error.h"
#include "thesis/zerotrees/header_bytes.h"
#include "thesis/zerotrees/jpeg4d_blocks.h"
#include "thesis/zerotrees/jpeg4d_table.h"
#include "thesis/zerotrees/quantise.h"

namespace hogel::zerotrees {
namespace {

constexpr int b_limit = 30;
constexpr std::size_t jpeg4d_header_bytes = 5;
constexpr int own_table = 0x80;  // flag in the byte of b_max

struct LevelModels {
    explicit LevelModels(int b_max) : tuples(static_cast<std::size_t>((z_max + 1) * (b_max + 1))) {}
    coding::SymbolModel tuples;
    // Models of the bit below the leading one, by the number of bits. Lower bits are nearly equally likely and have
    // none.
    std::array<coding::BitModel, b_limit + 1> second;
};

void check_jpeg4d_size(const wavelets::Pyramid& pyramid, std::size_t size) {
    if (size != pyramid.size())
        throw Error(ErrorCode::usage,
                    fmt::format("jpeg4d: {} values given, expected the {} of the pyramid", size, pyramid.size()));
}

double max_level(const Blocks& blocks, std::span<const float> values, const Quantisation& quantisation) {
    double max_steps = 0;
    const auto min_magnitudes = min_values(blocks, quantisation);
    for (std::size_t number = 0; number < blocks.count(); ++number) {
        const Blocks::Block block = blocks[number];
        const Blocks::Kind& kind = blocks.kind(block);
        for_each_large(kind, &values[block.origin], min_magnitudes[block.kind], [&](std::size_t entry, float value) {
            max_steps = std::max(max_steps, std::abs(value) / quantisation.steps[kind.full_index[entry]]);
        });
    }
    return std::floor(max_steps + (1 - quantisation.round_up));
}

void write_level(coding::ArithmeticEncoder& encoder, LevelModels& models, int bits, std::int32_t level) {
    const auto magnitude = static_cast<std::uint32_t>(std::abs(level));
    encoder.raw(level < 0, 1);
    if (bits < 2) return;
    encoder.bit(models.second[static_cast<std::size_t>(bits)], magnitude >> (bits - 2) & 1);
    encoder.raw(magnitude, bits - 2);
}

std::int32_t read_level(coding::ArithmeticDecoder& decoder, LevelModels& models, int bits) {
    const bool negative = decoder.raw(1) != 0;
    std::uint32_t magnitude = 1;
    if (bits >= 2) {
        magnitude = 2 | static_cast<std::uint32_t>(decoder.bit(models.second[static_cast<std::size_t>(bits)]));
        magnitude = magnitude << (bits - 2) | decoder.raw(bits - 2);
    }
    return negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
}

// Calls take(position, level) for the nonzero levels of a block of `count` entries. Returns false if the
// tuples exceed the block.
template <class Take>
bool read_block(coding::ArithmeticDecoder& decoder, LevelModels& models, std::size_t count, Take&& take) {
    for (std::size_t position = 0; position < count && !decoder.ended(); ++position) {
        const auto symbol = static_cast<int>(decoder.symbol(models.tuples));
        const int bits = symbol / (z_max + 1), zeros = symbol % (z_max + 1);
        if (bits == 0 && zeros == 0) return true;
        if (bits == 0) {
            position += static_cast<std::size_t>(zeros) - 1;  // the loop adds one more
            continue;
        }
        position += static_cast<std::size_t>(zeros);
        if (position >= count) return false;
        take(position, read_level(decoder, models, bits));
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> jpeg4d_encode(const wavelets::Pyramid& pyramid, std::span<const float> values, double scale,
                                        QuantisationTable table) {
    check_jpeg4d_size(pyramid, values.size());
    const float max_value = coding::max_magnitude(values), stored_scale = static_cast<float>(scale);
    const auto impossible = [&] {
        throw Error(ErrorCode::usage, "step",
                    fmt::format("jpeg4d: a scale of {} for magnitudes up to {}, expected levels of 1 to 30 bits", scale,
                                max_value));
    };
    if (!(stored_scale > 0) || !std::isfinite(stored_scale)) impossible();
    const Blocks blocks(pyramid);
    bool has_own_table = table == QuantisationTable::own;
    Exponents exponents;
    Quantisation quantisation = jpegs_quantisation(stored_scale, blocks.axes());
    if (has_own_table) {
        exponents.assign(quantisation.steps.size(), 0);
        quantisation = own_quantisation(stored_scale, exponents);
    }
    double largest = max_level(blocks, values, quantisation);
    if (largest >= std::ldexp(1.0, b_limit)) impossible();
    if (has_own_table && largest > 0) {
        exponents = choose_exponents(blocks, values, stored_scale);
        quantisation = own_quantisation(stored_scale, exponents);
        largest = max_level(blocks, values, quantisation);
    }
    has_own_table = has_own_table && largest > 0;  // if all values are zero, no table is needed
    const int b_max = std::bit_width(static_cast<std::uint32_t>(largest));
    std::vector<std::uint8_t> bytes;
    put_float(bytes, stored_scale);
    bytes.push_back(static_cast<std::uint8_t>(b_max | (has_own_table ? own_table : 0)));
    coding::ArithmeticEncoder encoder;
    if (has_own_table) write_exponents(encoder, blocks, exponents);
    LevelModels models(b_max);
    SparseLevels levels;
    const auto min_magnitudes = min_values(blocks, quantisation);
    for (std::size_t number = 0; number < blocks.count(); ++number) {
        const Blocks::Block block = blocks[number];
        const Blocks::Kind& kind = blocks.kind(block);
        quantise_block(kind, &values[block.origin], min_magnitudes[block.kind], quantisation, levels);
        for_each_tuple(levels, kind.offsets.size(), [&](const Tuple& tuple, std::int32_t level) {
            encoder.symbol(models.tuples, tuple.symbol());
            if (tuple.bits > 0) write_level(encoder, models, tuple.bits, level);
        });
    }
    const std::vector<std::uint8_t> code = encoder.finish();
    bytes.insert(bytes.end(), code.begin(), code.end());
    return bytes;
}

void jpeg4d_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values) {
    check_jpeg4d_size(pyramid, values.size());
    const auto damaged = [](const char* problem) {
        throw Error(ErrorCode::bad_input, fmt::format("jpeg4d stream: {}, expected a whole undamaged one", problem));
    };
    if (bytes.size() < jpeg4d_header_bytes) damaged("it ends within its header");
    const double scale = get_float(bytes);
    if (!(scale > 0) || !std::isfinite(scale)) damaged("its scale is not a positive number");
    const bool has_own_table = (bytes[4] & own_table) != 0;
    const int b_max = bytes[4] & ~own_table;
    if (b_max > b_limit) damaged("it has levels of more than 30 bits");
    const Blocks blocks(pyramid);
    coding::ArithmeticDecoder decoder(bytes.subspan(jpeg4d_header_bytes));
    Quantisation quantisation = jpegs_quantisation(scale, blocks.axes());
    if (has_own_table) {
        Exponents exponents;
        if (!read_exponents(decoder, blocks, exponents)) damaged("its quantisation table is damaged");
        quantisation = own_quantisation(scale, exponents);
    }
    LevelModels models(b_max);
    std::ranges::fill(values, 0.0f);
    for (std::size_t number = 0; number < blocks.count(); ++number) {
        const Blocks::Block block = blocks[number];
        const Blocks::Kind& kind = blocks.kind(block);
        const bool is_complete =
            read_block(decoder, models, kind.offsets.size(), [&](std::size_t position, std::int32_t level) {
                const std::size_t entry = kind.entry[position];
                const double step = quantisation.steps[kind.full_index[entry]];
                values[block.origin + kind.offsets[entry]] = static_cast<float>(step * level);
            });
        if (!is_complete) damaged("a run of zeros exceeds a block");
        if (decoder.ended()) damaged("it ends too early or is damaged");
    }
    if (!decoder.all_read()) damaged("bytes are left over");
}

}  // namespace hogel::zerotrees
