// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace hogel::render {

/// Maps a float to an integer such that unsigned comparison orders them as the floats, also below zero.
constexpr std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return bits ^ (bits >> 31 != 0 ? 0xffffffffu : 0x80000000u);
}

}  // namespace hogel::render
