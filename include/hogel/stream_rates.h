// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "hogel/array.h"
#include "hogel/export.h"
#include "hogel/progress.h"

namespace hogel {

/// The bytes that each hogel takes in a stream of compress(), [t][s], of all faces and without depth. With the coder
/// hogel those of its own code and its share of what the tile's hogels have in common; other coders code the hogels of
/// a tile together, so that each of them counts alike. The sum is that of the stream's tiles. Reads the file once, and
/// decodes nothing. Throws Error(bad_input) for what is no stream, or damaged, Error(usage) for more layers than it
/// has.
/// @param layers  the first layers alone, by which later ones add their hogels; 0: all that the file has
HOGEL_API Array<double, 2> bytes_of_hogels(const std::filesystem::path& path, std::size_t layers = 0,
                                           const Progress& progress = {});

}  // namespace hogel
