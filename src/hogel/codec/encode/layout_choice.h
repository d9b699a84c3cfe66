// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/compress.h"

namespace hogel::codec::encode {

// Chooses the layout of a stream: the one of the options, or by default `stacked` if it is possible and codes sample
// tiles of each face in fewer bytes than `faces` (docs/decisions/0040-codec-layouts.md). Throws Error(usage) for an
// impossible layout.
// @param info       complete except for the layout
// @param coder_of   returns the coder of a face in a stream
using CoderOfFace = std::function<std::unique_ptr<TileCoder>(const StreamInfo& info, const LightFieldGrid& face)>;
StreamLayout choose_layout(const LightField& light_field, const StreamInfo& info, const CompressionOptions& options,
                           const CoderOfFace& coder_of);

}  // namespace hogel::codec::encode
