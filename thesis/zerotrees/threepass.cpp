// SPDX-License-Identifier: Apache-2.0
#include "thesis/zerotrees/threepass.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "hogel/coding/histogram_rule.h"
#include "hogel/error.h"
#include "thesis/zerotrees/header_bytes.h"
#include "thesis/zerotrees/three_pass_symbols.h"
#include "thesis/zerotrees/three_pass_trees.h"

namespace hogel::zerotrees {
namespace {

constexpr std::size_t three_pass_header_bytes = 5;

// Flag in the byte with the number of bit planes: symbols are coded from alphabets.
constexpr std::uint8_t with_alphabets = 0x80;

[[noreturn]] void damaged(const char* problem) {
    throw Error(ErrorCode::bad_input, fmt::format("three-pass stream: {}, expected a whole undamaged one", problem));
}

void check_three_pass_size(const wavelets::Pyramid& pyramid, std::size_t size) {
    if (size != pyramid.size())
        throw Error(ErrorCode::usage, fmt::format("three-pass coder: {} values given, expected the {} of the pyramid",
                                                  size, pyramid.size()));
}

}  // namespace

std::vector<std::uint8_t> three_pass_encode(const wavelets::Pyramid& pyramid, std::span<const float> values,
                                            double step, ThreePassSymbols symbols) {
    check_three_pass_size(pyramid, values.size());
    const float max_value = coding::max_magnitude(values), stored_step = static_cast<float>(step);
    if (!(stored_step > 0) || !std::isfinite(stored_step) || max_value / stored_step > std::ldexp(1.0f, max_planes))
        throw Error(
            ErrorCode::usage, "step",
            fmt::format("three-pass coder: a step of {} for magnitudes up to {}, expected one from 2^-30 of that", step,
                        max_value));
    const Quantiser quantiser(stored_step);
    const int planes = std::bit_width(quantiser.level(max_value));
    std::vector<std::uint8_t> bytes;
    put_float(bytes, stored_step);
    const bool alphabets = symbols == ThreePassSymbols::alphabets;
    bytes.push_back(static_cast<std::uint8_t>(planes | (alphabets ? with_alphabets : 0)));
    const Forest forest(pyramid);
    const auto write = [&](auto encoding) {
        write_three_pass(forest, values, quantiser, planes, encoding);
        return encoding.symbols.coder.encoder.finish();
    };
    const std::vector<std::uint8_t> code =
        alphabets ? write(Encoding<AlphabetSymbols>(planes)) : write(Encoding<BitSymbols>(planes));
    bytes.insert(bytes.end(), code.begin(), code.end());
    return bytes;
}

void three_pass_decode(const wavelets::Pyramid& pyramid, std::span<const std::uint8_t> bytes, std::span<float> values) {
    check_three_pass_size(pyramid, values.size());
    if (bytes.size() < three_pass_header_bytes) damaged("it ends within its header");
    const float step = get_float(bytes);
    const int planes = bytes[4] & ~with_alphabets;
    if (!(step > 0) || !std::isfinite(step)) damaged("its step is not a positive number");
    if (planes > max_planes) damaged("it has more than 30 bit planes");
    const auto read = [&](auto decoding) {
        read_three_pass(Forest(pyramid), Quantiser(step), planes, decoding, values);
        if (decoding.decoder().ended()) damaged("it ends too early or is damaged");
        if (!decoding.decoder().all_read()) damaged("bytes are left over");
    };
    if (bytes[4] & with_alphabets)
        read(Decoding<AlphabetSymbols>(planes, bytes.subspan(three_pass_header_bytes)));
    else
        read(Decoding<BitSymbols>(planes, bytes.subspan(three_pass_header_bytes)));
}

void three_pass_round(std::span<const std::uint8_t> bytes, std::span<float> values) {
    const Quantiser quantiser(get_float(bytes));
    for (float& value : values) {
        const std::uint32_t level = quantiser.level(value);
        value = level == 0 ? 0 : quantiser.value(level, value < 0);
    }
}

}  // namespace hogel::zerotrees
