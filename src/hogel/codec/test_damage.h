// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hogel/codec/format/bytes.h"
#include "hogel/compress.h"
#include "hogel/error.h"

namespace hogel::codec {

/// Returns whether decoding a tile's bytes throws; the error must be Error(bad_input).
inline bool refuses(const TileCoder& coder, std::span<const std::uint8_t> bytes, LightFieldTile tile) {
    try {
        coder.decode(bytes, tile);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return true;
    }
    return false;
}

/// Truncates the code of a tile at every `cut`-th byte and appends to it: decoding must fail. Flips a bit of every
/// `flip`-th byte: decoding must yield a tile or fail.
inline void expect_harmless_damage(const TileCoder& coder, const std::vector<std::uint8_t>& good,
                                   const LightFieldTile& tile, std::size_t cut, std::size_t flip) {
    EXPECT_FALSE(refuses(coder, good, tile));
    for (std::size_t length = 0; length < good.size(); length += cut)
        ASSERT_TRUE(refuses(coder, std::span(good).first(length), tile)) << length;
    for (std::size_t at = 0; at < good.size(); at += flip) {
        std::vector<std::uint8_t> bad = good;
        bad[at] = static_cast<std::uint8_t>(bad[at] ^ 1 << at % 8);
        refuses(coder, bad, tile);
    }
    std::vector<std::uint8_t> longer = good;
    longer.insert(longer.end(), 8, 0x55);
    EXPECT_TRUE(refuses(coder, longer, tile));
}

/// Returns the end of the header of a stream, the offset of its checksum.
inline std::size_t end_of_header(const std::vector<std::uint8_t>& stream) {
    return 16 + (stream[12] | std::size_t{stream[13]} << 8);
}

/// Returns the stream with a number in its header replaced and the checksum corrected.
inline std::vector<std::uint8_t> with_number(std::vector<std::uint8_t> stream, std::size_t at, std::uint64_t value) {
    const std::size_t end = end_of_header(stream);
    for (std::size_t i = 0; i < 8; ++i) stream[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
    const std::uint32_t sum = core::checksum(std::span(std::as_const(stream)).first(end));
    for (std::size_t i = 0; i < 4; ++i) stream[end + i] = static_cast<std::uint8_t>(sum >> (8 * i));
    return stream;
}

}  // namespace hogel::codec
