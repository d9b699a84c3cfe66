// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/make.h"

namespace hogel::cli {

/// The facts that `hogel make` reports about its run, beside what it has made.
struct Report {
    std::string scene;
    std::size_t triangles = 0;
    std::uintmax_t light_field_bytes = 0;                ///< of the file; 0: it is not kept
    std::string render_command;                          ///< which renders the light field again
    std::string scene_input;                             ///< what identifies the scene: see describe_input()
    std::vector<std::string> work;                       ///< what identifies the run: see work_of()
    std::vector<std::pair<std::string, double>> stages;  ///< name, seconds
    Metadata run;                                        ///< with the options that acted on any output
};

/// The number of looks of the photographs by waves; 0: there are only those without speckle.
std::size_t looks_of(const Made& made);
/// The grids of the holograms of all wavelengths.
std::vector<FieldGrid> grids_of(const Made& made);

/// A self-contained HTML page with embedded pictures.
/// @param folder  holds the PNG files of the pictures
std::string report_html(const Report& report, const Made& made, const std::filesystem::path& folder);
/// The same numbers as JSON, in SI units.
std::string report_json(const Report& report, const Made& made);
/// Whether a folder holds the report of a complete run of this work.
bool has_report_of(const std::filesystem::path& folder, const std::vector<std::string>& work);

}  // namespace hogel::cli
