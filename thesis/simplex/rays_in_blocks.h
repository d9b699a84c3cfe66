// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "hogel/core/stop_scope.h"
#include "hogel/light_field.h"
#include "hogel/render/span.h"

namespace hogel::simplex {

/// Calls use(t, s, v, u) for all directions of the hogels in some rows and columns, in blocks of a few hogels of a row.
/// The fastest index is s in depth buffers and u in tiles; blocks use full cache lines of both.
template <class Use>
void for_each_ray(const LightFieldGrid& grid, const render::Span& rows, const render::Span& columns, const Use& use) {
    constexpr std::size_t hogels_at_once = 16;
    for (std::size_t t = rows.first; t < rows.end; ++t)
        for (std::size_t first = columns.first; first < columns.end; first += hogels_at_once) {
            const std::size_t end = std::min(first + hogels_at_once, columns.end);
            for (std::size_t v = 0; v < grid.directions_v; ++v) {
                core::throw_if_stopped();
                for (std::size_t u = 0; u < grid.directions_u; ++u)
                    for (std::size_t s = first; s < end; ++s) use(t, s, v, u);
            }
        }
}

}  // namespace hogel::simplex
