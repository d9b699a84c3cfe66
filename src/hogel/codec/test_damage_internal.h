#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

#include "hogel/codec/tile_coder.h"
#include "hogel/core/error.h"

namespace hogel {

/// Whether a tile's bytes are refused, which must be by Error(bad_input).
inline bool refuses(const TileCoder& coder, std::span<const std::uint8_t> bytes, LightFieldTile tile) {
    try {
        coder.decode(bytes, tile);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_input);
        return true;
    }
    return false;
}

/// Cuts the code of a tile at every `cut`-th byte and appends to it, which must be refused, and flips a bit of every
/// `flip`-th byte, which must end in a tile or be refused.
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

}  // namespace hogel
