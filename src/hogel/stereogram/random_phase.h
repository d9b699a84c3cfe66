// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <span>

namespace hogel::stereogram {

/// A series of random phases: the generator's key, and the words of its counter other than the number of the draw.
struct PhaseSeries {
    std::array<std::uint32_t, 2> key;       ///< the seed
    std::array<std::uint32_t, 3> position;  ///< look and colour, column and row of the hogel
};

/// values[i] = moduli[i] · e^{2πi b_i/256}, where b_i is byte i mod 16 of Philox's draw number i/16: an independent
/// phase for every coefficient, which does not depend on the order in which hogels are made. 256 equal steps are as
/// good as a continuum: the first 255 circular moments vanish exactly, and speckle depends only on the first few. The
/// first value may belong to a later draw.
void spread_random_phases(const PhaseSeries& series, std::span<const float> moduli,
                          std::span<std::complex<float>> values, std::uint32_t first_draw = 0);

/// Tables of e^{2πi b/256} as real and imaginary parts: for all bytes, and for bytes whose upper or lower half is zero.
struct PhaseRoots {
    alignas(64) float re[256], im[256];
    alignas(64) float upper_re[16], upper_im[16], lower_re[16], lower_im[16];
};
const PhaseRoots& phase_roots();

}  // namespace hogel::stereogram
