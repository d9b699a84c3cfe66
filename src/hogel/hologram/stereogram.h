#pragma once

#include <cstdint>
#include <memory>

#include "hogel/lightfield/light_field.h"
#include "hogel/optics/field.h"

namespace hogel {

struct StereogramOptions {
    double wavelength = 633e-9;  ///< metres
    double pitch = 1e-6;         ///< Δ asked for, metres; rounded so that a hogel holds whole samples
    std::size_t channel = 0;     ///< channel of the light field that this wavelength shows
    std::size_t looks = 1;       ///< independent sets of random phases on offer
    std::uint64_t seed = 1;
};

/// The grid of samples that a stereogram of this light field has: n_Δ = round(d/Δ) samples a hogel in each direction.
/// Throws Error(usage) when the light field's field of view exceeds the diffraction half-angle asin(λ/2Δ), naming the
/// pitch that would do.
FieldGrid stereogram_grid(const LightFieldGrid& light_field, const StereogramOptions& options);

/// The plain holographic stereogram: one inverse FFT a hogel over the frequency grid j/d, amplitudes √L interpolated
/// from the light field, an independent random phase for each look, hogel and direction. Made on demand, region by
/// region. Source: [K] (4.2). The light field must outlive the result.
std::unique_ptr<FieldSource> make_stereogram(const LightFieldSource& light_field, const StereogramOptions& options);

}  // namespace hogel
