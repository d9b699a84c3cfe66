// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hogel/scene/mesh_files/transfer.h"

namespace hogel::scene::mesh_files {

/// Whether a file begins as one in the Object File Format does ("OFF", "COFF", "NOFF", "STOFF", "4OFF", "nOFF" ...).
bool starts_like_off(std::string_view bytes);

/// Reads a text file in the Object File Format of Geomview: vertices, with normals, colours and texture coordinates
/// where the header says so, and polygons, whose colours are shown where vertices have none. Throws Error(bad_input),
/// which names the line.
/// @param bytes  the whole file
Imported read_off(const std::string& file, std::string_view bytes);

}  // namespace hogel::scene::mesh_files
