// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/field.h"
#include "hogel/progress.h"
#include "hogel/resources.h"

namespace hogel {

/// A field on a parallel plane, on the same grid. It is given room around it and keeps all directions that could bring
/// light from one end of the grid to the other; those that go farther fade out, and do not come in again.
/// Throws Error(usage) for a distance that is not finite.
Field propagate(const FieldSource& field, double distance, std::size_t look = 0);

/// The same from a source to a sink, with what does not fit into memory in a file.
void propagate(const FieldSource& field, double distance, FieldSink& sink, std::size_t look,
               const ScratchOptions& scratch, const Progress& progress = {});

}  // namespace hogel
