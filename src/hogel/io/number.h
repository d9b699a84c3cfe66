// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace hogel::io {

/// Number types in a file, little-endian. `real` is a double, `boolean` a byte that is 0 or not.
enum class Number { boolean, int8, uint8, int16, uint16, int32, uint32, int64, uint64, half, single, real };

inline std::size_t bytes_of(Number number) {
    switch (number) {
        case Number::boolean:
        case Number::int8:
        case Number::uint8:
            return 1;
        case Number::int16:
        case Number::uint16:
        case Number::half:
            return 2;
        case Number::int32:
        case Number::uint32:
        case Number::single:
            return 4;
        case Number::int64:
        case Number::uint64:
        case Number::real:
            break;
    }
    return 8;
}

}  // namespace hogel::io
