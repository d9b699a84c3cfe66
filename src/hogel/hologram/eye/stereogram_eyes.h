// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hogel/hologram/hogel_synthesis.h"
#include "hogel/optics/eye_light.h"

namespace hogel::hologram::eye {

/// What eyes need of a stereogram whose hogels are sums of the waves of their Fourier transforms.
struct Hogels {
    FieldGrid grid;
    std::size_t samples = 0;  ///< along a side of a hogel
    const HogelWaves* waves = nullptr;
    std::size_t prepared_size = 0;
    /// Computes the prepared values of a range, [hogel][prepared_size], row by row.
    std::function<void(const HogelRange&, View<float, 2>)> prepare;
    /// The prepared values of all hogels of the grid, row by row, where they are kept; otherwise no elements.
    View<const float, 2> kept = {};
};

/// The samples of an eye's band to a hogel, along an axis, for hogels of `samples` samples a side.
std::size_t band_samples_per_hogel(const FieldGrid& hologram, std::size_t samples, const optics::Eye& eye);

/// Whether computing so many samples of a band costs less than those of the hogels: at most half as many. A band that
/// is nearly as dense as the samples saves nothing.
constexpr bool band_is_cheaper(std::size_t per_hogel, std::size_t samples) { return 2 * per_hogel <= samples; }

/// The light of a range of hogels of a stereogram towards eyes, without its samples. Null where an eye receives so
/// many of a hogel's waves that computing the samples costs less.
std::unique_ptr<optics::EyeDrawing> make_stereogram_eyes(const Hogels& hogels, const HogelRange& range,
                                                         std::span<const optics::Eye> eyes);

}  // namespace hogel::hologram::eye
