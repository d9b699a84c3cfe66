#include "hogel/coding/jpeg4d.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "hogel/coding/arithmetic.h"
#include "hogel/coding/bytes_internal.h"
#include "hogel/coding/jpeg4d_internal.h"
#include "hogel/coding/quantise.h"
#include "hogel/core/error.h"

namespace hogel {
namespace {

constexpr int b_limit = 30;
constexpr std::size_t header = 5;

struct Models {
    explicit Models(int b_max) : tuples(static_cast<std::size_t>((z_max + 1) * (b_max + 1))) {}
    SymbolModel tuples;
    // Of the bit below the leading one, by the number of bits; the lower ones are nearly even.
    std::array<BitModel, b_limit + 1> second;
};

// Calls visit(block) for all blocks.
template <class Visit>
void for_each_block(const Blocks& blocks, Visit&& visit) {
    Blocks::Block block;
    for (std::size_t number = 0; number < blocks.count(); ++number) {
        blocks.get(number, block);
        visit(block);
    }
}

double squared_error(const Blocks& blocks, std::span<const float> values, double scale) {
    double sum = 0;
    for_each_block(blocks, [&](const Blocks::Block& block) {
        for (std::size_t i = 0; i < block.offsets.size(); ++i) {
            const double step = scale * block.table[i], value = values[block.offsets[i]];
            const double error = value - step * std::nearbyint(value / step);
            sum += error * error;
        }
    });
    return sum;
}

void check_size(const Pyramid& pyramid, std::size_t size) {
    if (size != pyramid.size())
        throw Error(ErrorCode::usage,
                    fmt::format("jpeg4d: {} values given, expected the {} of the pyramid", size, pyramid.size()));
}

void write_block(ArithmeticEncoder& encoder, Models& models, const BlockSymbols& symbols) {
    auto level = symbols.levels.begin();
    for (const Tuple& tuple : symbols.tuples) {
        encoder.symbol(models.tuples, static_cast<std::size_t>(tuple.bits * (z_max + 1) + tuple.zeros));
        if (tuple.bits == 0) continue;
        const auto magnitude = static_cast<std::uint32_t>(std::abs(*level));
        encoder.raw(*level < 0, 1);
        ++level;
        if (tuple.bits < 2) continue;
        encoder.bit(models.second[static_cast<std::size_t>(tuple.bits)], magnitude >> (tuple.bits - 2) & 1);
        encoder.raw(magnitude, tuple.bits - 2);
    }
}

// Fills in the levels of a block, which are zero. False when the tuples run past its end.
bool read_block(ArithmeticDecoder& decoder, Models& models, std::span<std::int32_t> levels) {
    for (std::size_t at = 0; at < levels.size() && !decoder.ended(); ++at) {
        const auto symbol = static_cast<int>(decoder.symbol(models.tuples));
        const int bits = symbol / (z_max + 1), zeros = symbol % (z_max + 1);
        if (bits == 0 && zeros == 0) return true;
        if (bits == 0) {
            at += static_cast<std::size_t>(zeros) - 1;  // and one by the loop
            continue;
        }
        at += static_cast<std::size_t>(zeros);
        if (at >= levels.size()) return false;
        const bool negative = decoder.raw(1) != 0;
        std::uint32_t magnitude = 1;
        if (bits >= 2) {
            magnitude = 2 | static_cast<std::uint32_t>(decoder.bit(models.second[static_cast<std::size_t>(bits)]));
            magnitude = magnitude << (bits - 2) | decoder.raw(bits - 2);
        }
        levels[at] = negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> jpeg4d_encode(const Pyramid& pyramid, std::span<const float> values, double scale) {
    check_size(pyramid, values.size());
    const float most = largest_magnitude(values), stored_scale = static_cast<float>(scale);
    const Blocks blocks(pyramid);
    const auto level_of = [&](const Blocks::Block& block, std::size_t i) {
        return std::nearbyint(values[block.offsets[i]] / (static_cast<double>(stored_scale) * block.table[i]));
    };
    double largest = 0;
    if (stored_scale > 0 && std::isfinite(stored_scale))
        for_each_block(blocks, [&](const Blocks::Block& block) {
            for (std::size_t i = 0; i < block.offsets.size(); ++i)
                largest = std::max(largest, std::abs(level_of(block, i)));
        });
    if (!(stored_scale > 0) || !std::isfinite(stored_scale) || largest >= std::ldexp(1.0, b_limit))
        throw Error(
            ErrorCode::usage,
            fmt::format("jpeg4d: a scale of {} for magnitudes up to {}, expected levels of 1 to 30 bits", scale, most));
    const int b_max = std::bit_width(static_cast<std::uint32_t>(largest));
    std::vector<std::uint8_t> bytes;
    put_float(bytes, stored_scale);
    bytes.push_back(static_cast<std::uint8_t>(b_max));
    ArithmeticEncoder encoder;
    Models models(b_max);
    std::vector<std::int32_t> levels;
    for_each_block(blocks, [&](const Blocks::Block& block) {
        levels.clear();
        for (std::size_t i = 0; i < block.offsets.size(); ++i)
            levels.push_back(static_cast<std::int32_t>(level_of(block, i)));
        write_block(encoder, models, block_symbols(levels));
    });
    const std::vector<std::uint8_t> code = encoder.finish();
    bytes.insert(bytes.end(), code.begin(), code.end());
    return bytes;
}

void jpeg4d_decode(const Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values) {
    check_size(pyramid, values.size());
    const auto damaged = [](const char* what) {
        throw Error(ErrorCode::bad_input, fmt::format("jpeg4d stream: {}, expected a whole undamaged one", what));
    };
    if (bytes.size() < header) damaged("it ends within its header");
    const double scale = get_float(bytes);
    if (!(scale > 0) || !std::isfinite(scale)) damaged("its scale is not a positive number");
    if (bytes[4] > b_limit) damaged("it has levels of more than 30 bits");
    ArithmeticDecoder decoder(bytes.subspan(header));
    Models models(bytes[4]);
    std::vector<std::int32_t> levels;
    for_each_block(Blocks(pyramid), [&](const Blocks::Block& block) {
        levels.assign(block.offsets.size(), 0);
        if (!read_block(decoder, models, levels)) damaged("a row of zeros runs past the end of a block");
        if (decoder.ended()) damaged("it ends too early or is damaged");
        for (std::size_t i = 0; i < levels.size(); ++i)
            values[block.offsets[i]] = static_cast<float>(scale * block.table[i] * levels[i]);
    });
    if (!decoder.all_read()) damaged("bytes are left over");
}

double jpeg4d_scale_for_sqnr(const Pyramid& pyramid, std::span<const float> values, double sqnr) {
    check_size(pyramid, values.size());
    if (!(sqnr > 0 && sqnr <= 130))
        throw Error(ErrorCode::usage,
                    fmt::format("jpeg4d: an SQNR of {} dB, expected more than 0 and at most 130", sqnr));
    const double most = largest_magnitude(values);
    if (most == 0) return 1;
    const Blocks blocks(pyramid);
    const double allowed = energy(values) * std::pow(10, -sqnr / 10);
    // The table's entries lie between 1 and 121²: the first scale leaves nothing, the last all that a float has.
    double coarse = 4 * most, fine = most * 0x1p-44;
    while (coarse > fine * 1.001) {
        const double scale = std::sqrt(coarse * fine);
        (squared_error(blocks, values, scale) <= allowed ? fine : coarse) = scale;
    }
    return fine;
}

}  // namespace hogel
