// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hogel/camera/photograph_plan.h"
#include "hogel/camera/pupil_band_source.h"
#include "hogel/image.h"

namespace hogel::camera {

/// The light of one hologram or several colours of one towards the eyes of cameras: the bands of all eyes of the first
/// colour, then of the next.
struct ColourBands {
    std::unique_ptr<PupilBandSource> drawing;
    std::vector<FieldGrid> colours;
    std::vector<SharedViewpoint> eyes;
    Rectangle shown;  ///< what the films show
    std::size_t looks = 1, looks_at_once = 1;
    bool preview = false;
};

/// The eyes that see through the widest pupils of their cameras.
std::vector<Viewpoint> viewpoints_of(std::span<const SharedViewpoint> eyes, std::span<const Camera> cameras,
                                     bool preview);

/// Draws all looks, exposes a film of each colour and camera to them, and adds it to the camera's picture of that
/// colour. In a team, the first process does the latter.
/// @param pictures  [colour][camera]
void expose(const ColourBands& bands, std::span<const Camera> cameras, std::span<const std::span<Image>> pictures,
            const Progress& progress);

}  // namespace hogel::camera
