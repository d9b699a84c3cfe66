// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/resources.h"

namespace hogel {

struct PropagateOptions {
    std::size_t look = 0;                  ///< of the field
    ScratchOptions scratch{SIZE_MAX, {}};  ///< for the arrays of the work; by default they are in memory
};

/// The field on a parallel plane `distance` metres farther along +z, on the same grid, whole in memory. By the angular
/// spectrum, [K] 6.1.1, with room around the field: the result has all directions that bring light from one end of the
/// grid to the other; steeper ones fade out and do not wrap around. Throws Error(usage) for a distance that is not
/// finite.
HOGEL_API Field propagate(const FieldSource& field, double distance, const PropagateOptions& options = {},
                          const Progress& progress = {});

/// Writes the propagated field to a sink, which need not be in memory. Calls finish().
HOGEL_API void propagate(const FieldSource& field, double distance, FieldSink& sink,
                         const PropagateOptions& options = {}, const Progress& progress = {});

}  // namespace hogel
