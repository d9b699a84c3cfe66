// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/compress.h"
#include "hogel/files.h"

namespace hogel::io {

/// Add facts to summarize(): the sampling of a light field's front; its faces and the sampling of the sides; the plane
/// of field number `index`; and a compressed light field.
void describe(const LightFieldGrid& grid, FileSummary& summary);
void describe_faces(const std::vector<LightFieldGrid>& grids, FileSummary& summary);
void describe(const FieldGrid& grid, std::size_t index, FileSummary& summary);
void describe(const StreamInfo& info, FileSummary& summary);

}  // namespace hogel::io
