// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hogel/photograph.h"

namespace hogel::camera {

/// Photographs of all colours of a hologram at once, [colour][camera], as photograph() takes them one by one: where
/// rays have to be made for each of them and all bands fit into memory together. Otherwise none.
std::optional<std::vector<std::vector<Image>>> photograph_together(
    std::span<const std::shared_ptr<const FieldSource>> colours, std::span<const Camera> cameras,
    const BandCamera& model, const Progress& progress);

}  // namespace hogel::camera
