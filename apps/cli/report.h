// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/camera.h"
#include "hogel/field.h"
#include "hogel/image.h"
#include "hogel/light_field.h"

namespace hogel::cli {

/// One view of the hologram, photographed by waves and, as reference, by rays.
struct PhotographPair {
    std::string eye_name, focus_name;  ///< "left", "plane": parts of the file names
    Camera camera;
    Image wave;      ///< the mean of the looks; empty without looks
    Image expected;  ///< the mean of infinitely many looks; empty where it is left out
    Image geometric;
    std::string wave_file, expected_file, geometric_file;  ///< names in the report's folder, without extension
    ImageComparison comparison, expected_comparison;       ///< of the waves with the rays
};

/// All facts that `hogel make` reports about its run.
struct Report {
    std::string scene;
    std::size_t triangles = 0;
    std::string algorithm;
    LightFieldGrid light_field;
    std::uintmax_t light_field_bytes = 0;  ///< of the file; 0: it is not kept
    std::string render_command;            ///< which renders the light field again
    std::string scene_input;               ///< what identifies the scene: see describe_input()
    std::vector<std::string> work;         ///< what identifies the run: see work_of()
    std::vector<FieldGrid> holograms;
    std::size_t looks = 0;  ///< 0: only the mean of infinitely many
    bool expected = true;   ///< whether there are means of infinitely many looks
    std::size_t pupil_samples = 0;
    double exposure = 1;  ///< of all pictures
    std::vector<PhotographPair> pairs;
    std::vector<std::pair<std::string, double>> stages;  ///< name, seconds
    std::size_t threads = 0;
    Metadata run;  ///< with the options that acted on any output
    /// With those that acted on photographs by waves, on their means of infinitely many looks, and on those by rays.
    Metadata waves_run, expected_run, rays_run;
};

/// A self-contained HTML page with embedded pictures.
/// @param folder  holds the PNG files of the pictures
std::string report_html(const Report& report, const std::filesystem::path& folder);
/// The same numbers as JSON, in SI units.
std::string report_json(const Report& report);
/// Whether a folder holds the report of a complete run of this work.
bool has_report_of(const std::filesystem::path& folder, const std::vector<std::string>& work);

}  // namespace hogel::cli
