// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "hogel/propagate.h"

namespace hogel::direct {

/// Propagates a field by `distance` metres and accepts any error. By default propagate() refuses relative errors above
/// 1e-3, also those due to light at grazing directions that it drops. Scene surfaces with random phases can exceed
/// that, because they emit into all directions that their samples resolve.
inline Field onward(const Field& field, double distance) {
    PropagateOptions options;
    options.max_error = std::numeric_limits<double>::infinity();
    return propagate(field, distance, options);
}

}  // namespace hogel::direct
