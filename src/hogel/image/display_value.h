// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace hogel::image {

/// The 8-bit sRGB value of linear light: 255 srgb_encode(linear), rounded; 0 for what is not a number.
std::uint8_t plain_display_value(float linear);

/// The same, from a table: with its sign, exponent and seven bits of its mantissa a number is one of two values, and a
/// comparison says which.
std::uint8_t display_value(float linear);

}  // namespace hogel::image
