// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/rays/ray_blocks.h"

#include <algorithm>

#include "hogel/error.h"

namespace hogel::camera::rays {
namespace {

// Returns the size of a block: rows of hogels as long as possible, which suits the fastest renderer and files, and
// enough rows to keep the share of hogels in two blocks small.
HogelRange block_size(const LightFieldGrid& grid) {
    constexpr std::size_t rows = 16;
    const std::size_t hogel_bytes = grid.channels * grid.directions() * sizeof(float);
    const std::size_t max_hogels = std::max<std::size_t>(1, max_block_bytes / hogel_bytes);
    const std::size_t nt = std::min({rows, grid.hogels_t, max_hogels});
    return {0, 0, std::min(grid.hogels_s, max_hogels / nt), nt};
}

}  // namespace

std::vector<Block> blocks(const LightFieldGrid& grid) {
    const HogelRange size = block_size(grid);
    // Cells lie between neighbours, so there is one less than hogels; a single hogel is its own cell.
    const std::size_t cells_s = std::max<std::size_t>(grid.hogels_s - 1, 1),
                      cells_t = std::max<std::size_t>(grid.hogels_t - 1, 1);
    std::vector<Block> list;
    for (std::size_t t = 0; t < cells_t; t += size.nt)
        for (std::size_t s = 0; s < cells_s; s += size.ns) {
            const HogelRange cells{s, t, std::min(size.ns, cells_s - s), std::min(size.nt, cells_t - t)};
            list.push_back(
                {cells, {s, t, std::min(cells.ns + 1, grid.hogels_s - s), std::min(cells.nt + 1, grid.hogels_t - t)}});
        }
    return list;
}

void require_ray_camera(const Camera& camera) {
    validate(camera);
    if (camera.focus_slope_x != 0 || camera.focus_slope_y != 0)
        throw Error(ErrorCode::usage, "focus_tilt", "the ray camera does not support a tilted plane in focus");
}

}  // namespace hogel::camera::rays
