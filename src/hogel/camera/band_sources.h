// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "hogel/camera/hogel_spectra/kept_waves.h"
#include "hogel/camera/pupil_band_source.h"
#include "hogel/photograph.h"

namespace hogel::camera {

/// The drawing of a part of a field towards eyes: from its hogels if it knows them, that costs less and `source` allows
/// it, otherwise from its samples. Throws Error(usage) where hogels are asked for and cannot be used.
/// @param window      the part as a field of its own; it and `whole` must live as long as the drawing
/// @param kept_waves  those of the first look of hogels, or null
std::unique_ptr<PupilBandSource> make_band_source(const FieldSource& whole, const Region& part,
                                                  const FieldSource& window, std::span<const Viewpoint> eyes,
                                                  BandSource source,
                                                  const hogel_spectra::KeptWaves* kept_waves = nullptr);

}  // namespace hogel::camera
