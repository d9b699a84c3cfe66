// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace hogel::io::arrays {

constexpr std::uint32_t type_int8 = 1, type_uint8 = 2, type_uint16 = 4, type_int32 = 5, type_uint32 = 6,
                        type_single = 7, type_double = 9, type_array = 14, type_compressed = 15;

}  // namespace hogel::io::arrays
