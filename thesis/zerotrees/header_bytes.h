// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace hogel::zerotrees {

// Floats at the head of a coder's stream, little-endian.
inline void put_float(std::vector<std::uint8_t>& bytes, float value) {
    const auto word = std::bit_cast<std::uint32_t>(value);
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

inline float get_float(std::span<const std::uint8_t> bytes) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{bytes[i]} << (8 * i);
    return std::bit_cast<float>(word);
}

}  // namespace hogel::zerotrees
