// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// The layout of a stream of a light field: that of the options, or by default `stacked` where it is possible and takes
// fewer bytes for some tiles of each face than `faces` (docs/decisions/0041-codec-stacked-layout.md). Throws
// Error(usage) for a layout that is impossible.
// @param info       complete but for the layout
// @param coder_of   makes the coder of a face in a stream
using CoderOfFace = std::function<std::unique_ptr<TileCoder>(const StreamInfo& info, const LightFieldGrid& face)>;
StreamLayout choose_layout(const LightField& light_field, const StreamInfo& info, const CompressionOptions& options,
                           const CoderOfFace& coder_of);

}  // namespace hogel::codec::encode
