// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hogel/photograph.h"

namespace hogel::camera {

/// Photographs all colours of a hologram at once, [colour][camera], with the result of photograph() for each colour.
/// Returns nothing unless the colours need the same rays, which are not in memory, and all their bands fit into memory.
std::optional<std::vector<std::vector<Image>>> photograph_together(
    std::span<const std::shared_ptr<const FieldSource>> colours, std::span<const Camera> cameras,
    const BandCamera& model, const Progress& progress);

}  // namespace hogel::camera
