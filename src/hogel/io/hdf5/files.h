// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "hogel/files.h"

namespace hogel::io::hdf5 {

/// HDF5 files as the rest of the module sees them: nothing outside this folder includes HDF5's own header.

/// True for a plain file that begins as HDF5 does. Throws Error(bad_input) where there is no such file.
bool is_hdf5(const std::filesystem::path& path);

/// Light field, hologram, or unknown, by the attribute "format". Throws Error(bad_input).
FileKind kind_of(const std::filesystem::path& path);

/// Adds what a light field or a hologram says about itself. Throws Error(bad_input).
void summarize(const std::filesystem::path& path, FileSummary& summary);

/// The faces of a light field, the front first. Throws Error(bad_input).
LightField open_light_field(const std::filesystem::path& path);

}  // namespace hogel::io::hdf5
