// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/geometry.h"

namespace hogel::scene::mesh_files {

/// Changes "-.5" to "-0.5" in vertices, because assimp 5.2 does not parse the former.
std::string with_leading_zeros(std::string text);

/// Moves the vertices of an OBJ text to the origin, because assimp reads single floats, whose step on map coordinates
/// is half a metre. The text is unchanged if the vertices are near the origin relative to their extent.
/// @param offset  receives the offset that was subtracted from each vertex
std::string about_the_origin(std::string text, Vec3& offset);

}  // namespace hogel::scene::mesh_files
