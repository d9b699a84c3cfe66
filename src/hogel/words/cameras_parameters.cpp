// SPDX-License-Identifier: Apache-2.0
#include "hogel/requests.h"

namespace hogel {

LightFieldGrid CamerasParameters::grid() const {
    LightFieldGrid grid;
    grid.hogels_s = hogels.columns;
    grid.hogels_t = hogels.rows;
    grid.pitch = size / static_cast<double>(hogels.columns);
    grid.directions_u = directions.columns;
    grid.directions_v = directions.rows;
    grid.view = FocalPlane{hogel::field_of_view(field_of_view.across, field_of_view.down), -distance};
    return grid;
}

void CamerasParameters::declare(Parameters& parameters) {
    parameters.positive_length("--size", size, "Width of the hologram in the scene to be rendered; import scales it");
    parameters.counts("--hogels", hogels, "Columns and rows of hogels, and pixels of each picture");
    parameters.counts("--directions", directions, "Columns and rows of cameras");
    parameters.angles("--fov", field_of_view,
                      "Full angles spanned by rows and columns of cameras, seen from the hologram");
    parameters.positive_length("--distance", distance, "Distance from the cameras to the hologram")
        .sets_parameter("focal_plane");
}

}  // namespace hogel
