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

/// Pupil bands of one or several colours of a hologram, in the order [colour][viewpoint].
struct ColourBands {
    std::unique_ptr<PupilBandSource> source;
    std::vector<FieldGrid> colours;
    std::vector<SharedViewpoint> viewpoints;
    Rectangle shown;  ///< area of the hologram plane that the films show
    std::size_t looks = 1, looks_at_once = 1;
    bool preview = false;
};

/// Returns a Viewpoint for each shared viewpoint, with the largest pupil of its cameras.
std::vector<Viewpoint> viewpoints_of(std::span<const SharedViewpoint> viewpoints, std::span<const Camera> cameras,
                                     bool preview);

/// Synthesises all looks, exposes a film of each colour and camera to them, and adds each film to the picture of its
/// camera and colour. With MPI, only the root exposes films and changes pictures.
/// @param pictures  [colour][camera]
void expose(const ColourBands& bands, std::span<const Camera> cameras, std::span<const std::span<Image>> pictures,
            const Progress& progress);

}  // namespace hogel::camera
