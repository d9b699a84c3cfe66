// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hogel/pipeline.h"
#include "view/settings.h"

namespace hogel::view {

/// Facts about a compressed light field.
struct StreamFacts {
    std::size_t layers = 0, of_layers = 0;  ///< layers shown, and layers in the file
    double bytes = 0;                       ///< size of the shown layers
    std::string original;                   ///< reference of the errors; empty: all layers of the file
    std::optional<double> sqnr, psnr;       ///< decibels, once measured; infinite without errors
};

/// Returns the slider values of a scene and the advice, for the page, in SI units and degrees.
nlohmann::ordered_json facts_of_scene(const Settings& settings, const std::vector<Advice>& advice, bool is_file);
nlohmann::ordered_json facts_of_stream(const StreamFacts& stream);

}  // namespace hogel::view
