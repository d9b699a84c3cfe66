#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <span>

namespace hogel {

/// Which random phases: a key, and what the counter of the generator says beside the number of the draw.
struct PhaseSeries {
    std::array<std::uint32_t, 2> key;       ///< the seed
    std::array<std::uint32_t, 3> position;  ///< look and colour, column and row of the hogel
};

/// values[i] = moduli[i] · e^{2πi b_i/256}, where b_i is byte i mod 16 of Philox's draw number i/16: a phase of its own
/// for every coefficient, the same in whatever order hogels are made. 256 equal steps are as good as a continuum: the
/// first 255 circular moments vanish exactly, and speckle depends on the first few alone.
void spread_random_phases(const PhaseSeries& series, std::span<const float> moduli,
                          std::span<std::complex<float>> values);

}  // namespace hogel
