// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/renderer.h"

namespace hogel::render {

/// Returns the rows of renderers() that reproduce [K] chapter 5. Defined in thesis/simplex.
std::vector<RendererInfo> thesis_renderers();

}  // namespace hogel::render
