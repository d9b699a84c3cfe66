// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "hogel/camera/hogel_spectra/kept_waves.h"
#include "hogel/camera/pupil_band_source.h"
#include "hogel/stereogram/stereogram.h"

namespace hogel::camera::hogel_spectra {

/// The light of a part of a stereogram towards eyes, without its samples; null where its hogels are no sums of waves,
/// or where an eye receives so many of a hogel's waves that computing the samples costs less. Hogels that the part cuts
/// belong to it.
/// @param kept_waves  those of its first look, or null
std::unique_ptr<PupilBandSource> make_hogel_band_source(const stereogram::Stereogram& hologram, const Region& part,
                                                        std::span<const Viewpoint> eyes,
                                                        const KeptWaves* kept_waves = nullptr);

/// The same for several colours of a hologram, if they need the same rays and these are not in memory: rays are made
/// once for all colours, which are drawn one after the other for a part of the hogels. The bands of all eyes of the
/// first colour, then of the next. Otherwise null.
std::unique_ptr<PupilBandSource> make_hogel_band_source_of_colours(
    std::span<const stereogram::Stereogram* const> colours, const Region& part, std::span<const Viewpoint> eyes);

}  // namespace hogel::camera::hogel_spectra
