// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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
    Image wave, geometric;
    std::string wave_file, geometric_file;  ///< names in the report's folder, without extension
    ImageComparison comparison;
};

/// All facts that `hogel make` reports about its run.
struct Report {
    std::string scene;
    std::size_t triangles = 0;
    std::string algorithm;
    LightFieldGrid light_field;
    std::uintmax_t light_field_bytes = 0;  ///< of the file
    std::vector<FieldGrid> holograms;
    std::size_t looks = 0;
    std::size_t pupil_samples = 0;
    double exposure = 1;  ///< of all pictures
    std::vector<PhotographPair> pairs;
    std::vector<std::pair<std::string, double>> stages;  ///< name, seconds
    std::size_t threads = 0;
    Metadata run;                  ///< with the options that acted on any output
    Metadata waves_run, rays_run;  ///< with those that acted on the photographs by waves, and by rays
};

/// A self-contained HTML page with embedded pictures.
std::string report_html(const Report& report);
/// The same numbers as JSON, in SI units.
std::string report_json(const Report& report);

}  // namespace hogel::cli
