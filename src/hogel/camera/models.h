// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/photograph.h"

namespace hogel::camera {

/// Implement photograph_into(), each for one camera model. They check all arguments before they change a picture.
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const BandCamera& model,
                   std::span<Image> pictures, const Progress& progress);
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const SpeckleFreeCamera& model,
                   std::span<Image> pictures, const Progress& progress);
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const PlaneWaveCamera& model,
                   std::span<Image> pictures, const Progress& progress);
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const DirectCamera& model,
                   std::span<Image> pictures, const Progress& progress);

/// Returns the band camera that plan_photographs() assumes: the model itself if it is one, otherwise a default one.
BandCamera planned_as(const CameraModel& model);

/// Throws the errors that photograph() throws for a PlaneWaveCamera before it begins.
void require_by_plane_waves(const FieldGrid& hologram, std::span<const Camera> cameras, const PlaneWaveCamera& model);

}  // namespace hogel::camera
