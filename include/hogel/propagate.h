// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "hogel/export.h"
#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/resources.h"

namespace hogel {

/// Options of propagate().
struct PropagateOptions {
    std::size_t look = 0;                  ///< the look of the field to propagate
    ScratchOptions scratch{SIZE_MAX, {}};  ///< for work arrays; by default they are in memory
};

/// Propagates a field to a parallel plane, `distance` metres farther along +z (backwards if negative). The result is on
/// the same grid and completely in memory. Angular spectrum method, [K] 6.1.1, on a zero-padded grid: the result has
/// all directions that lead from any point of the grid to any other; steeper ones fade out and do not wrap around.
/// Throws Error(usage) for a distance that is not finite.
HOGEL_API Field propagate(const FieldSource& field, double distance, const PropagateOptions& options = {},
                          const Progress& progress = {});

/// As above, but writes the propagated field to a sink, which need not be in memory, and calls finish().
HOGEL_API void propagate(const FieldSource& field, double distance, FieldSink& sink,
                         const PropagateOptions& options = {}, const Progress& progress = {});

}  // namespace hogel
