// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// Adds the triangles of a polygon that have an area. Throws Error(bad_input) for a corner that does not exist and for
/// more corners than a polygon may have.
/// @param mirrored  whether the front is where the corners go clockwise
void add_polygon(std::span<const std::uint32_t> corners, bool mirrored, const std::string& file, Mesh& mesh);

}  // namespace hogel::scene::mesh_files
