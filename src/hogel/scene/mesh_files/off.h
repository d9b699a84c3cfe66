// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// Returns whether a file has a keyword of the Object File Format ("OFF", "COFF", "NOFF", "STOFF", "4OFF", "nOFF" ...).
bool starts_like_off(std::string_view bytes);

/// Reads Geomview's Object File Format (text): vertices with optional attributes, and polygons, whose colours apply if
/// vertices have none. Throws Error(bad_input), naming the line.
Imported read_off(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
