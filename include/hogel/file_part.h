// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/light_field.h"
#include "hogel/progress.h"

namespace hogel {

/// A part of a light field or hologram file that several programs write without knowing of each other: number `number`,
/// from 1, of `count`. A part holds some of the rows of hogels of every face, or some of the rows of samples of every
/// field, and the header of the whole file.
struct FilePart {
    std::size_t number = 1, count = 1;
    /// What the parts must have in common beside the options in the metadata: the input.
    std::string input = {};
};

/// Writes a part of what write_light_field() would write. Part files are no HDF5 files: join_parts() makes one of them
/// all. Throws Error(usage) if there are more parts than rows of hogels, and what write_light_field() throws.
HOGEL_API void write_light_field_part(const std::filesystem::path& path, const LightField& light_field,
                                      const LightFieldFileOptions& options, const FilePart& part,
                                      const Progress& progress = {});

/// Writes a part of what write_holograms() would write, in rows of samples that begin and end with hogels. Throws
/// Error(usage) if there are more parts than rows of hogels, and what write_holograms() throws.
HOGEL_API void write_holograms_part(const std::filesystem::path& path, const Fields& holograms,
                                    const HologramFileOptions& options, const FilePart& part,
                                    const Progress& progress = {});

/// Joins the parts of a file, in any order. The file has the same bytes as one that was written whole. Throws
/// Error(bad_input) if a part is missing, given twice, of another file or damaged, and Error(cannot_write).
HOGEL_API void join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path> parts,
                          const Progress& progress = {});

}  // namespace hogel
