// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "hogel/camera/hogel_spectra/wave_cache.h"
#include "hogel/camera/pupil_band_source.h"
#include "hogel/photograph.h"

namespace hogel::camera {

/// Returns the source of the pupil bands of a part of a field. It uses the hogel spectra if they are known, cost less
/// and `source` allows them, and otherwise the samples. Throws Error(usage) if `source` demands hogel spectra that
/// cannot be used.
///
/// @param window      the part as a field of its own; it and `hologram` must outlive the result
/// @param wave_cache  waves of the first look, or null
std::unique_ptr<PupilBandSource> make_band_source(const FieldSource& hologram, const Region& part,
                                                  const FieldSource& window, std::span<const Viewpoint> viewpoints,
                                                  BandSource source,
                                                  const hogel_spectra::WaveCache* wave_cache = nullptr);

}  // namespace hogel::camera
