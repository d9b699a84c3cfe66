// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/photograph.h"

namespace hogel::camera {

/// photograph_into() by each model. Pictures are changed only after what photograph() throws before it begins.
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const BandCamera& model,
                   std::span<Image> pictures, const Progress& progress);
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const SpeckleFreeCamera& model,
                   std::span<Image> pictures, const Progress& progress);
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const PlaneWaveCamera& model,
                   std::span<Image> pictures, const Progress& progress);
void photograph_by(const FieldSource& hologram, std::span<const Camera> cameras, const DirectCamera& model,
                   std::span<Image> pictures, const Progress& progress);

/// The band camera of whose photographs those of this model have the plan: itself, or one with the defaults.
BandCamera planned_as(const CameraModel& model);

/// Throws what photograph() throws for a PlaneWaveCamera before it begins.
void require_by_plane_waves(const FieldGrid& hologram, std::span<const Camera> cameras, const PlaneWaveCamera& model);

}  // namespace hogel::camera
