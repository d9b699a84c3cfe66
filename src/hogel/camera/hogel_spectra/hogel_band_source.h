// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "hogel/camera/hogel_spectra/wave_cache.h"
#include "hogel/camera/pupil_band_source.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::camera::hogel_spectra {

/// Returns a source of the pupil bands of a part of a stereogram, directly from hogel spectra, without computing
/// samples. Returns null if its hogels are not sums of waves, or if a band is so wide that computing the samples costs
/// less. Hogels that the part cuts belong to it.
/// @param wave_cache  waves of the first look, or null
std::unique_ptr<PupilBandSource> make_hogel_band_source(const stereogram::Stereogram& hologram, const Region& part,
                                                        std::span<const Viewpoint> viewpoints,
                                                        const WaveCache* wave_cache = nullptr);

/// Does the same for several colours of a hologram: rays are made once for all colours, which are rendered one after
/// the other for each chunk of hogels. Bands are in the order [colour][viewpoint]. Returns null unless the colours need
/// the same rays, which are not in memory.
std::unique_ptr<PupilBandSource> make_hogel_band_source_of_colours(
    std::span<const stereogram::Stereogram* const> colours, const Region& part, std::span<const Viewpoint> viewpoints);

}  // namespace hogel::camera::hogel_spectra
