// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/codec/encode/block_search.h"

namespace hogel::codec::encode {

// Decides on all blocks of a hogel and reconstructs its picture, in memory of the caller, exactly as a
// decoder will. The result includes the predictor candidates.
format::CodedHogel analyse(const format::TileSetup& setup, std::size_t hogel, const format::Picture& source,
                           const KnownDisparities& known, std::vector<format::Picture>& pictures);

}  // namespace hogel::codec::encode
