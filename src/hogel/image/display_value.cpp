// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/display_value.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "hogel/image.h"

namespace hogel::image {
namespace {

constexpr unsigned shift = 16;      // keeps 7 of the 23 mantissa bits
constexpr float lowest = 0x1p-13f;  // 255·12.92 times this is 0.40, which rounds to 0
constexpr std::uint32_t first = std::bit_cast<std::uint32_t>(lowest) >> shift;
constexpr std::size_t count = (std::bit_cast<std::uint32_t>(1.0f) >> shift) - first;

// Numbers with equal upper bits have the value `low` below `step`, and low + 1 from `step`. A bucket contains at most
// one step: its width is at most x/128 at x, and 255 d(srgb)/dx · x/128 is at most 0.66, at x = 1/2.
struct Bucket {
    float step = 0;
    std::uint8_t low = 0;
};

// Finds the first number of a bucket with a value above `low` by bisection, or the end of the bucket.
Bucket bucket(std::uint32_t upper) {
    std::uint32_t below = upper << shift, above = (upper + 1) << shift;
    const std::uint8_t low = plain_display_value(std::bit_cast<float>(below));
    while (above - below > 1) {
        const std::uint32_t middle = below + (above - below) / 2;
        (plain_display_value(std::bit_cast<float>(middle)) > low ? above : below) = middle;
    }
    return {std::bit_cast<float>(above), low};
}

std::array<Bucket, count> make_buckets() {
    std::array<Bucket, count> buckets;
    for (std::size_t i = 0; i < count; ++i) buckets[i] = bucket(first + static_cast<std::uint32_t>(i));
    return buckets;
}

const std::array<Bucket, count>& buckets() {
    static const std::array<Bucket, count> table = make_buckets();
    return table;
}

}  // namespace

std::uint8_t plain_display_value(float linear) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_encode(linear)));
}

std::uint8_t display_value(float linear) {
    if (!(linear > lowest)) return 0;
    if (linear >= 1) return 255;
    const Bucket& found = buckets()[(std::bit_cast<std::uint32_t>(linear) >> shift) - first];
    return static_cast<std::uint8_t>(found.low + (linear >= found.step ? 1 : 0));
}

}  // namespace hogel::image
