// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#include "hogel/geometry.h"

namespace hogel::scene {

/// The finaliser of splitmix64.
inline std::uint64_t mix_bits(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    return bits ^ (bits >> 31);
}

/// Returns a hash of the position; −0 equals 0.
inline std::uint64_t position_hash(const Vec3& p) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    return mix_bits(mix_bits(mix_bits(bits(p.x)) + bits(p.y)) + bits(p.z));
}

}  // namespace hogel::scene
