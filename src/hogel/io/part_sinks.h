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

struct Rows {
    std::size_t first = 0, count = 0;
};

/// Part `number`, from 1, of `count` of a file.
struct PartNumber {
    std::size_t number = 1, count = 1;
    std::string input;  ///< input that all parts must have in common, beside attributes and sampling
};

/// Create sinks for the rows of each face or field; tiles count rows from the first of the part. Errors are those of
/// create_light_field() and create_hologram(). `grids` are those of the complete file.
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
