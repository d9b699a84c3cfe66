// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hogel/scene/mesh_files/points.h"
#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// A PLY file: a point cloud where it has neither faces nor strips, or one mesh for each picture that its faces name.
struct PlyContents {
    std::optional<Points> points;
    Imported surfaces;  ///< meshes, textures and notes; with points only notes
};

/// Reads a PLY file of text or of bytes in either order; elements and properties may come in any order. Throws
/// Error(bad_input), which names the element, for data that end early or contradict the header, for an index of a
/// vertex that does not exist, for Gaussian splats, and for a file without vertices.
/// @param file   for messages
/// @param bytes  the whole file
PlyContents read_ply(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
