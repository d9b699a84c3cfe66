// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/checksum.h"

#include <array>

namespace hogel::core {
namespace {

constexpr std::size_t at_once = 8;

// Remainders of a byte followed by 0 to 7 zero bytes, so that eight bytes are looked up at a time and independently of
// each other ("slicing by 8").
constexpr std::array<std::array<std::uint32_t, 256>, at_once> tables = [] {
    std::array<std::array<std::uint32_t, 256>, at_once> remainders{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t rest = byte;
        for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ (rest & 1 ? 0xEDB88320u : 0u);
        remainders[0][byte] = rest;
    }
    for (std::size_t zeros = 1; zeros < at_once; ++zeros)
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t before = remainders[zeros - 1][byte];
            remainders[zeros][byte] = before >> 8 ^ remainders[0][before & 0xFF];
        }
    return remainders;
}();

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
    std::uint32_t rest = 0xFFFFFFFFu;
    for (; bytes.size() >= at_once; bytes = bytes.subspan(at_once)) {
        std::uint32_t next = 0;
        for (std::size_t k = 0; k < at_once; ++k) {
            const std::uint32_t old = k < 4 ? rest >> (8 * k) : 0;
            next ^= tables[at_once - 1 - k][(old ^ bytes[k]) & 0xFF];
        }
        rest = next;
    }
    for (const std::uint8_t byte : bytes) rest = rest >> 8 ^ tables[0][(rest ^ byte) & 0xFF];
    return ~rest;
}

}  // namespace hogel::core
