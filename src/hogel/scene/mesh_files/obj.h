// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace hogel::scene::mesh_files {

/// The text of an OBJ file in which no number of a vertex begins with its decimal point: "-.5" becomes "-0.5", which
/// means the same, because assimp 5.2 takes the former for no number.
std::string with_leading_zeros(std::string text);

}  // namespace hogel::scene::mesh_files
