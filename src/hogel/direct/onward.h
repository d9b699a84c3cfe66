// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "hogel/propagate.h"

namespace hogel::direct {

/// The field on a plane `distance` farther on, whatever light it has at grazing directions: holograms from scenes are
/// made of surfaces with random phases, which shine into all directions that their samples have.
inline Field onward(const Field& field, double distance) {
    PropagateOptions options;
    options.max_error = std::numeric_limits<double>::infinity();
    return propagate(field, distance, options);
}

}  // namespace hogel::direct
