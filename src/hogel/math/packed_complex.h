// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>

namespace hogel::math {

/// A finite complex number in 32 bits: two signed 12-bit integers times a shared power of two. The rounding error of
/// each part is at most 1/2047 of the larger part, and no number is too large. Numbers below 2^-116 become zero.
struct PackedComplex {
    std::uint32_t bits = 0;  ///< [real part : 12][imaginary part : 12][biased exponent : 8]

    friend bool operator==(const PackedComplex&, const PackedComplex&) = default;
};

/// Biased float exponent of the unit of packed parts; the larger part gets eleven bits.
inline constexpr std::uint32_t packed_shift = 10;

/// Returns the nearest packed number: rounds each part to nearest, ties to even.
inline PackedComplex pack(std::complex<float> value) {
    const float larger = std::fmax(std::fabs(value.real()), std::fabs(value.imag()));
    // A part that rounds up to 2048 needs the next exponent.
    std::uint32_t exponent = (std::bit_cast<std::uint32_t>(larger) + (1u << 12)) >> 23;
    if (exponent < packed_shift) exponent = packed_shift;
    const auto scale = std::bit_cast<float>((2 * 127 + packed_shift - exponent) << 23);
    const auto part = [&](float number) { return static_cast<std::uint32_t>(std::lrintf(number * scale)); };
    return {part(value.real()) << 20 | (part(value.imag()) & 0xfff) << 8 | (exponent - packed_shift)};
}

/// Returns the exact value of a packed number.
inline std::complex<float> unpacked(PackedComplex packed) {
    const auto scale = std::bit_cast<float>((packed.bits & 0xff) << 23);
    const auto part = [&](std::uint32_t bits) {
        return scale * static_cast<float>(static_cast<std::int32_t>(bits) >> 20);
    };
    return {part(packed.bits), part(packed.bits << 12)};
}

/// Packs n numbers.
void pack(const std::complex<float>* from, PackedComplex* to, std::size_t n);

}  // namespace hogel::math
