// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "hogel/files.h"

namespace hogel::io::hdf5 {

/// Only this folder includes HDF5's header. Without HDF5 all but is_hdf5() throw Error(not_built_in).

/// Returns whether a regular file begins with HDF5's signature. Throws Error(bad_input) if it does not exist.
bool is_hdf5(const std::filesystem::path& path);

/// Returns light field, hologram or unknown, according to the attribute "format". Throws Error(bad_input).
FileKind kind_of(const std::filesystem::path& path);

/// Adds the facts about a light field or a hologram to a summary. Throws Error(bad_input).
void summarize(const std::filesystem::path& path, FileSummary& summary);

/// Writes levels, [y][x] of 0 to `largest`, as SLM.save_phase() of slmsuite does. Throws Error(cannot_write).
void write_slmsuite_file(const std::filesystem::path& path, View<const std::uint16_t, 2> levels, std::size_t largest);

/// Opens the faces of a light field, the front first. Throws Error(bad_input).
LightField open_light_field(const std::filesystem::path& path);

}  // namespace hogel::io::hdf5
