// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hogel/renderer.h"

namespace hogel::simplex {

/// Implements make_interpolating_renderer(). The renderer also counts its visits (visits.h).
std::unique_ptr<Renderer> interpolating_renderer(std::shared_ptr<const ShadedScene> scene, const LightFieldGrid& grid,
                                                 std::size_t region);

}  // namespace hogel::simplex
