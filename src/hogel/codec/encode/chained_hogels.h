// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hogel/light_field.h"

namespace hogel::codec::encode {

// Decodes a tile of the coder "hogel" as it was in versions 1 and 2 of the format: all hogels in one code, so that none
// can be had without those before it. Throws Error(bad_input).
void decode_chained_hogels(std::span<const std::uint8_t> bytes, const LightFieldGrid& grid, LightFieldTile& tile);

}  // namespace hogel::codec::encode
