// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hogel/scene/mesh_files/points.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// A point cloud if the file has neither faces nor strips, otherwise one mesh per picture of its faces.
struct PlyContents {
    std::optional<Points> points;
    Imported surfaces;  ///< meshes, textures and notes; only notes for a point cloud
};

/// Reads a complete ASCII or binary PLY file; elements and properties may come in any order. Throws Error(bad_input),
/// naming `file` and the element, for data that end early or contradict the header, for invalid vertex indices, for
/// Gaussian splats, and for a file without vertices.
PlyContents read_ply(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
