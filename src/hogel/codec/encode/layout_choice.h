// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// How a stream of these faces is laid out: as the options say, or where they leave it open, gathered where that can be
// and takes fewer bytes of some hogels in the middle of each face. Rows of hogels that lie far apart show too little of
// the same for that. Throws Error(usage) for a layout that is impossible.
// @param info      of which the layout is still open
// @param coder_of  makes the coder of a face in a stream
using CoderOfFace = std::function<std::unique_ptr<TileCoder>(const StreamInfo& info, const LightFieldGrid& face)>;
StreamLayout choose_layout(std::span<const LightFieldSource* const> faces, const StreamInfo& info,
                           const CompressionOptions& options, const CoderOfFace& coder_of);

}  // namespace hogel::codec::encode
