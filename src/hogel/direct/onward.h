// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "hogel/propagate.h"

namespace hogel::direct {

/// Propagates a field by `distance` metres without a limit on the light at grazing directions: scene surfaces with
/// random phases emit into all directions that their samples resolve.
inline Field onward(const Field& field, double distance) {
    PropagateOptions options;
    options.max_error = std::numeric_limits<double>::infinity();
    return propagate(field, distance, options);
}

}  // namespace hogel::direct
