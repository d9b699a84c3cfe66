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

/// Hogels across whose values are prepared together; down there are tile_side.
inline constexpr std::size_t block_across = 32;

/// What eyes need of a stereogram whose hogels are sums of the waves of their Fourier transforms.
struct Hogels : HogelLayout {
    const HogelWaves* waves = nullptr;
    /// Computes what `waves` needs of a range, [hogel][waves->prepared_size()], row by row.
    std::function<void(const HogelRange&, View<float, 2>)> prepare;
    /// The prepared values of all hogels of the grid, row by row, where they are kept; otherwise no elements.
    View<const float, 2> kept = {};
    /// Waves of the first look, where they are kept; otherwise null.
    const KeptWaves* kept_waves = nullptr;
};

/// The light of a range of hogels of stereograms of several colours towards eyes, without their samples: the bands of
/// all eyes of the first colour, then of the next. The colours of a strip of hogels are drawn one after the other. Null
/// where an eye receives so many of a hogel's waves that computing the samples costs less.
std::unique_ptr<optics::EyeDrawing> make_stereogram_eyes(std::span<const Hogels> colours, const HogelRange& range,
                                                         std::span<const optics::Eye> eyes);

}  // namespace hogel::hologram::eye
