// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/encode/block_search.h"

namespace hogel::codec::encode {

// Decides on all blocks of a hogel, and reconstructs its picture, whose memory is there, as a decoder will have it. The
// result has the predictor candidates, too.
format::CodedHogel analyse(const format::TileSetup& setup, std::size_t hogel, const format::Picture& source,
                           const KnownDisparities& known, std::vector<format::Picture>& pictures);

}  // namespace hogel::codec::encode
