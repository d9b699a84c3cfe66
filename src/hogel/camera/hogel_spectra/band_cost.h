// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hogel/camera/hogel_spectra/pupil_band.h"
#include "hogel/hologram.h"
#include "hogel/photograph.h"

namespace hogel::camera::hogel_spectra {

/// Returns the hogel layout of each colour. Returns an empty vector if the method's hogels are not sums of known waves.
std::vector<HogelLayout> layouts_of(const HologramMethod& method, const LightFieldGrid& light_field,
                                    std::span<const FieldGrid> colours);

/// Returns the resources to photograph a hologram of these colours from its hogel spectra.
Plan plan_from_hogels(std::span<const HogelLayout> colours, std::size_t looks, std::span<const Camera> cameras,
                      const BandCamera& model);

}  // namespace hogel::camera::hogel_spectra
