// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/geometry.h"

namespace hogel::scene::mesh_files {

/// The text of an OBJ file in which no number of a vertex begins with its decimal point: "-.5" becomes "-0.5", which
/// means the same, because assimp 5.2 takes the former for no number.
std::string with_leading_zeros(std::string text);

/// The text of an OBJ file whose vertices are about the origin: assimp reads single floats, which hold a place on a map
/// in steps of half a metre. A text whose vertices are not far away, by their distances from each other, stays as it
/// is.
/// @param offset  receives what was taken from each vertex
std::string about_the_origin(std::string text, Vec3& offset);

}  // namespace hogel::scene::mesh_files
