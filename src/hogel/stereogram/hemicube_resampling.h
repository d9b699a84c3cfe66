// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hogel/light_field.h"

namespace hogel::stereogram {

enum class Interpolation {
    linear,    ///< linear
    constant,  ///< nearest sample
};

/// Resamples the rays of several hemicube faces to the lobes of a hogel's frequencies. A lobe is the mean over points
/// of its frequency cell, at least two per covered ray and axis up to a limit. Each point is interpolated in the first
/// face that contains its direction. Points in no face and evanescent frequencies are dark.
struct HemicubeResampling {
    struct Lobe {
        std::uint32_t coefficient;   // of the DFT: [j_y mod n][j_x mod n], rows counted downwards
        std::uint32_t first, count;  // range of its rays and weights
        float scale;                 // (λ/d)² / cos θ, applied under the root
    };
    std::vector<Lobe> lobes;
    std::vector<std::uint32_t> rays;  // indices into the rays of all faces, face after face, [v][u] in each
    std::vector<float> weights;
};

/// Returns the lobes of the frequencies of a hogel with `samples` samples along a side, for rays of these faces.
/// @param step_y  height of a cell as a direction sine; for a line of frequencies a factor of the scale
/// @param line    frequencies along x only, from faces with one row of directions
HemicubeResampling scatter_lobes(std::span<const LightFieldGrid> faces, std::size_t samples, double step_y, bool line,
                                 double wavelength, Interpolation interpolation);

/// Computes out[lobe][hogel] = √(scale · Σ weight · values[ray][hogel]) for lobes first … first + count − 1; if
/// `of_roots`, √scale · Σ weight · values.
void average_scattered(const HemicubeResampling& lobes, std::size_t first, std::size_t count,
                       View<const float, 2> values, bool of_roots, float* out);

}  // namespace hogel::stereogram
