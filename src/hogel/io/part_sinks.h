// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hogel/files.h"
#include "hogel/progress.h"

namespace hogel::io {

/// Rows of hogels or of samples.
struct Rows {
    std::size_t first = 0, count = 0;
};

/// Which part of a file is written: number `number`, from 1, of `count`.
struct PartNumber {
    std::size_t number = 1, count = 1;
    std::string input;  ///< what the parts must have in common beside attributes and sampling: the input
};

/// Sinks of the rows of each face or field, which take tiles whose first row is number 0. Errors are those of
/// create_light_field() and create_hologram().
/// @param grids  of the whole file
std::vector<std::unique_ptr<LightFieldSink>> create_light_field_part(const std::filesystem::path& path,
                                                                     std::span<const LightFieldGrid> grids,
                                                                     const LightFieldFileOptions& options,
                                                                     const PartNumber& part, const Rows& rows);
std::vector<std::unique_ptr<FieldSink>> create_hologram_part(const std::filesystem::path& path,
                                                             std::span<const FieldGrid> grids,
                                                             const HologramFileOptions& options, const PartNumber& part,
                                                             std::span<const Rows> rows);

/// As hogel::join_parts().
void join_parts(const std::filesystem::path& path, std::span<const std::filesystem::path> parts,
                const Progress& progress);

}  // namespace hogel::io
