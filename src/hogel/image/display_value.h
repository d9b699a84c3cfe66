// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace hogel::image {

/// Returns the 8-bit sRGB value of linear light: 255 srgb_encode(linear), rounded; 0 for NaN.
std::uint8_t plain_display_value(float linear);

/// Table-based version of plain_display_value(). The sign, the exponent and seven mantissa bits leave two possible
/// values; one comparison selects between them.
std::uint8_t display_value(float linear);

}  // namespace hogel::image
