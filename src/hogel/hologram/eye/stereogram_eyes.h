// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/hologram/eye/eye_band.h"
#include "hogel/hologram/eye/kept_waves.h"
#include "hogel/hologram/hogel_synthesis.h"
#include "hogel/optics/eye_light.h"

namespace hogel::hologram::eye {

/// What eyes need of a stereogram whose hogels are sums of the waves of their Fourier transforms.
struct Hogels : HogelLayout {
    const HogelWaves* waves = nullptr;
    /// Computes what `waves` needs of a range, [hogel][waves->prepared_size()], row by row.
    std::function<void(const HogelRange&, View<float, 2>)> prepare;
    /// The prepared values of all hogels of the grid, row by row, where they are kept; otherwise no elements.
    View<const float, 2> kept = {};
    /// Waves of the first looks, where they are kept; otherwise null.
    const KeptWaves* kept_waves = nullptr;
};

/// The light of a range of hogels of a stereogram towards eyes, without its samples. Null where an eye receives so
/// many of a hogel's waves that computing the samples costs less.
std::unique_ptr<optics::EyeDrawing> make_stereogram_eyes(const Hogels& hogels, const HogelRange& range,
                                                         std::span<const optics::Eye> eyes);

}  // namespace hogel::hologram::eye
