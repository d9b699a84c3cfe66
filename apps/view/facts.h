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

/// What is known of a compressed light field.
struct StreamFacts {
    std::size_t layers = 0, of_layers = 0;  ///< shown, and in the file
    double bytes = 0;                       ///< that those layers take
    std::string original;                   ///< beside what errors are; empty: the whole file
    std::optional<double> sqnr, psnr;       ///< decibels, once they are measured; infinite where nothing differs
};

/// For the page, in SI units and degrees: what its sliders show of a scene, and what cannot be.
nlohmann::ordered_json facts_of_scene(const Settings& settings, const std::vector<Advice>& advice, bool is_file);
nlohmann::ordered_json facts_of_stream(const StreamFacts& stream);

}  // namespace hogel::view
