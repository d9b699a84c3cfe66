// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "hogel/codec/format/prediction.h"

namespace hogel::codec::encode {

inline format::BlockSamples block_of(const format::Plane& plane, std::size_t x, std::size_t y) {
    format::BlockSamples block;
    for (std::size_t r = 0; r < format::block_side; ++r)
        std::copy_n(&plane.samples[(y + r) * plane.width + x], format::block_side, &block[r * format::block_side]);
    return block;
}

}  // namespace hogel::codec::encode
