#include "hogel/core/checksum.h"

#include <array>

namespace hogel {
namespace {

constexpr std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> remainders{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t rest = byte;
        for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ (rest & 1 ? 0xEDB88320u : 0u);
        remainders[byte] = rest;
    }
    return remainders;
}();

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
    std::uint32_t rest = 0xFFFFFFFFu;
    for (const std::uint8_t byte : bytes) rest = rest >> 8 ^ table[(rest ^ byte) & 0xFF];
    return ~rest;
}

}  // namespace hogel
