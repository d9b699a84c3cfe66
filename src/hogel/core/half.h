// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace hogel::core {

/// Returns the IEEE 754 binary16 nearest to a float, ties to even; infinite from 65520. NaN stays NaN.
inline std::uint16_t half_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto size = static_cast<std::int32_t>(bits & 0x7fffffffu);
    // Normal halves: rebiases the exponent from 127 to 15 and rounds off 13 bits. A carry into the exponent is correct.
    std::int32_t normal = (size + 0xfff + ((size >> 13) & 1) - 0x38000000) >> 13;
    normal = normal > 0x7c00 ? 0x7c00 : normal;
    // Subnormal halves are multiples of 2^-24, the last bit of 0.5: the addition rounds.
    const float above_half = std::bit_cast<float>(size) + 0.5f;
    const std::int32_t subnormal = std::bit_cast<std::int32_t>(above_half) - 0x3f000000;
    const std::int32_t nan = 0x7e00 | ((size >> 13) & 0x3ff);
    std::int32_t half = size < 0x38800000 ? subnormal : normal;
    half = size > 0x7f800000 ? nan : half;
    return static_cast<std::uint16_t>(static_cast<std::uint32_t>(half) | ((bits >> 16) & 0x8000u));
}

/// Returns the exact value of a binary16.
inline float float_of(std::uint16_t half) {
    const std::int32_t size = half & 0x7fff;
    const float subnormal = static_cast<float>(size) * 0x1p-24f;
    const std::int32_t rebias = size >= 0x7c00 ? 0x70000000 : 0x38000000;  // infinity and NaN keep a full exponent
    std::int32_t bits = (size << 13) + rebias;
    bits = size < 0x400 ? std::bit_cast<std::int32_t>(subnormal) : bits;
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits) | (std::uint32_t{half} & 0x8000u) << 16);
}

/// Applies half_of() to n values.
extern void (&to_half)(const float* from, std::uint16_t* to, std::size_t n);
/// Applies float_of() to n values. Returns whether all results are finite.
extern bool (&to_float)(const std::uint16_t* from, float* to, std::size_t n);

}  // namespace hogel::core
