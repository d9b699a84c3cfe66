// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/make.h"

namespace hogel::cli {

/// Facts about a run of `hogel make` that Made does not contain.
struct Report {
    std::string scene;
    std::size_t triangles = 0;
    std::uintmax_t light_field_bytes = 0;                ///< size of the file; 0: the file is not kept
    std::string render_command;                          ///< renders the light field again
    std::string scene_input;                             ///< identifies the scene: see describe_input()
    std::vector<std::string> work;                       ///< identifies the run: see work_of()
    std::vector<std::pair<std::string, double>> stages;  ///< name, seconds
    Metadata run;                                        ///< metadata with the options that acted on any output
};

/// Returns the number of looks of the photographs by waves; 0: all are speckle-free.
std::size_t looks_of(const Made& made);
/// Returns the grids of the holograms of all wavelengths.
std::vector<FieldGrid> grids_of(const Made& made);

/// Returns a self-contained HTML page with embedded pictures.
/// @param folder  contains the PNG files of the pictures
std::string report_html(const Report& report, const Made& made, const std::filesystem::path& folder);
/// Returns the same numbers as JSON, in SI units.
std::string report_json(const Report& report, const Made& made);
/// Returns whether a folder contains the report of a complete run of this work.
bool has_report_of(const std::filesystem::path& folder, const std::vector<std::string>& work);

}  // namespace hogel::cli
