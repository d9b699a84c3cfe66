// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hogel/scene.h"

namespace hogel::scene::mesh_files {

/// Adds the non-degenerate triangles. Throws Error(bad_input) for an invalid corner index and for too many corners.
/// @param mirrored  whether the corners run clockwise, seen from the front
void add_polygon(std::span<const std::uint32_t> corners, bool mirrored, const std::string& file, Mesh& mesh);

}  // namespace hogel::scene::mesh_files
