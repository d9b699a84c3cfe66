// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hogel/codec/format/tone_curve.h"
#include "hogel/light_field.h"

namespace hogel::codec::format {

/// What radiances become before they are coded, and what is undone behind the decoder, so that coders do not know of
/// it. The colours of a ray are scaled alike, by y(L)/L of a curve, L = (R + G + B)/3; then, what they differ by from
/// their mean is divided. That mean is what coders separate as luminance: errors of chrominance change no factor.
struct Companding {
    std::optional<ToneCurve> tone;
    float chrominance = 1;  ///< 1 to max_chrominance: how much coarser its steps are than those of luminance
    static constexpr float max_chrominance = 1024;

    bool changes() const { return tone || chrominance != 1; }
    /// In place; radiance [c][t][s][v][u].
    void apply(View<float, 5> radiance) const;
    void undo(View<float, 5> radiance) const;
    friend bool operator==(const Companding&, const Companding&) = default;
};

/// The light field with its radiances mapped, where they are read. Both arguments must outlive it.
std::unique_ptr<LightFieldSource> companded(const LightFieldSource& source, const Companding& companding);

/// What luminances all of the light fields together have; reads them once, tile by tile on all threads.
LuminanceHistogram luminance_histogram(std::span<const LightFieldSource* const> faces, const Progress& progress = {});

}  // namespace hogel::codec::format
