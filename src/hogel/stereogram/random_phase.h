// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <span>

namespace hogel::stereogram {

/// Series of random phases: the generator's key and all of its counter words except the index of the draw.
struct PhaseSeries {
    std::array<std::uint32_t, 2> key;       ///< the seed
    std::array<std::uint32_t, 3> position;  ///< look and channel, column and row of the hogel
};

/// Computes values[i] = moduli[i] · e^{2πi b_i/256}, with b_i byte i mod 16 of Philox draw first_draw + i/16. Each
/// coefficient has an independent phase, for any order of hogels. 256 equal steps suffice: the first 255 circular
/// moments vanish exactly, and speckle depends only on the first few.
void spread_random_phases(const PhaseSeries& series, std::span<const float> moduli,
                          std::span<std::complex<float>> values, std::uint32_t first_draw = 0);

/// Tables of e^{2πi b/256} as real and imaginary parts: for all bytes b, and for bytes with a zero upper or lower half.
struct PhaseRoots {
    alignas(64) float re[256], im[256];
    alignas(64) float upper_re[16], upper_im[16], lower_re[16], lower_im[16];
};
const PhaseRoots& phase_roots();

}  // namespace hogel::stereogram
