// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hogel/codec/format/tone_curve.h"
#include "hogel/light_field.h"

namespace hogel::codec::format {

/// A mapping of radiances that is applied before coding and inverted after decoding; coders are independent of it. The
/// three colours of a ray are scaled by y(L)/L of a tone curve with L = (R + G + B)/3, then the differences from their
/// mean are divided by `chrominance`. Coders separate that mean as luminance, so errors of chrominance do not change
/// the scale.
struct Companding {
    std::optional<ToneCurve> tone;
    float chrominance = 1;  ///< divisor of chrominance, 1 to max_chrominance
    static constexpr float max_chrominance = 1024;

    bool changes() const { return tone || chrominance != 1; }
    /// Maps radiances [c][t][s][v][u] in place.
    void apply(View<float, 5> radiance) const;
    void undo(View<float, 5> radiance) const;
    friend bool operator==(const Companding&, const Companding&) = default;
};

/// Returns a light field that maps its radiances on reading.
LightField companded(const LightField& light_field, const Companding& companding);

/// Returns the histogram of the absolute luminance of all rays of all faces: |R + G + B|/3, or that of the only
/// channel. Reads the light field once, tile by tile on all threads of all ranks. All ranks get the sum.
LuminanceHistogram luminance_histogram(const LightField& light_field, const Progress& progress = {});

}  // namespace hogel::codec::format
