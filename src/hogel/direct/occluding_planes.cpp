// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "hogel/core/stop_scope.h"
#include "hogel/direct/depth_planes.h"
#include "hogel/direct/onward.h"
#include "hogel/optics/spectrum.h"
#include "hogel/work/parallel.h"

namespace hogel::direct {

// Back to front: propagates the light of the planes behind by the angular spectrum, blocks it where a plane is solid,
// and adds the plane's light. Source: Ichioka, Izumi and Suzuki, "Scanning halftone plotter and computer-generated
// continuous-tone hologram", Applied Optics 10, 1971, as described in [K] 3.4.2. In place of (3.13), the angular
// spectrum is valid at any distance, also in front of the hologram.
Field occluding_planes(const ShadedScene& scene, const FieldGrid& grid, const SceneHologramOptions& options,
                       const Progress& progress) {
    const core::StopScope scope(progress);
    validate(grid, ErrorCode::usage, "hologram");
    const SliceDrawing drawing(scene);
    const std::vector<Slice> slices = slices_of(scene, options.planes);
    Field field(grid);
    double depth = 0;
    bool dark = true;
    for (std::size_t i = slices.size(); i-- > 0;) {
        progress.report(1 - static_cast<double>(i + 1) / static_cast<double>(slices.size()));
        const SliceDrawing::Drawn drawn = drawing.draw(slices[i], grid.plane, grid.wavelength, options);
        if (drawn.empty) continue;
        if (!dark) field = onward(field, depth - slices[i].depth());
        depth = slices[i].depth();
        dark = false;
        work::parallel_for(field.samples.extent(0), [&](std::size_t row) {
            for (std::size_t column = 0; column < field.samples.extent(1); ++column)
                if (drawn.solid(row, column) > 0) field.samples(row, column) = drawn.light(row, column);
        });
    }
    if (!dark) field = onward(field, depth);
    progress.report(1);
    return field;
}

}  // namespace hogel::direct
