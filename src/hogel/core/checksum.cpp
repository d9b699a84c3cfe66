// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/checksum.h"

#include <array>

namespace hogel::core {
namespace {

constexpr std::size_t slices = 8;

// Remainders of a byte followed by 0 to 7 zero bytes. They allow eight independent look-ups at a time ("slicing by 8").
constexpr std::array<std::array<std::uint32_t, 256>, slices> tables = [] {
    std::array<std::array<std::uint32_t, 256>, slices> remainders{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit) remainder = remainder >> 1 ^ (remainder & 1 ? 0xEDB88320u : 0u);
        remainders[0][byte] = remainder;
    }
    for (std::size_t zeros = 1; zeros < slices; ++zeros)
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t previous = remainders[zeros - 1][byte];
            remainders[zeros][byte] = previous >> 8 ^ remainders[0][previous & 0xFF];
        }
    return remainders;
}();

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
    std::uint32_t remainder = 0xFFFFFFFFu;
    for (; bytes.size() >= slices; bytes = bytes.subspan(slices)) {
        std::uint32_t next = 0;
        for (std::size_t k = 0; k < slices; ++k) {
            const std::uint32_t old = k < 4 ? remainder >> (8 * k) : 0;
            next ^= tables[slices - 1 - k][(old ^ bytes[k]) & 0xFF];
        }
        remainder = next;
    }
    for (const std::uint8_t byte : bytes) remainder = remainder >> 8 ^ tables[0][(remainder ^ byte) & 0xFF];
    return ~remainder;
}

}  // namespace hogel::core
