// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "hogel/files.h"

namespace hogel::io::hdf5 {

/// The interface of HDF5 files to the rest of the module. Only files in this folder include HDF5's header. In a build
/// without HDF5 all but is_hdf5() throw Error(not_built_in).

/// Whether this is a regular file that begins like HDF5. Throws Error(bad_input) if it does not exist.
bool is_hdf5(const std::filesystem::path& path);

/// Light field, hologram or unknown, by the attribute "format". Throws Error(bad_input).
FileKind kind_of(const std::filesystem::path& path);

/// Adds the facts about a light field or a hologram to a summary. Throws Error(bad_input).
void summarize(const std::filesystem::path& path, FileSummary& summary);

/// The faces of a light field, the front first. Throws Error(bad_input).
LightField open_light_field(const std::filesystem::path& path);

}  // namespace hogel::io::hdf5
