// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/hologram/eye/colour_eyes.h"
#include "hogel/optics/eye_light.h"

namespace hogel::hologram::eye {

/// The light of a range of hogels of stereograms of several colours towards eyes, without their samples: the bands of
/// all eyes of the first colour, then of the next. The colours of a part of the hogels are drawn one after the other.
/// Null where an eye receives so many of a hogel's waves that computing the samples costs less.
std::unique_ptr<optics::EyeDrawing> make_stereogram_eyes(std::span<const Hogels> colours, const HogelRange& range,
                                                         std::span<const optics::Eye> eyes);

}  // namespace hogel::hologram::eye
