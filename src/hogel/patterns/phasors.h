// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>

namespace hogel::patterns {

/// The inner loops of the phase encodings, each in a plain and a SIMD version. Phases of the two agree to 1e-6 cycles,
/// modulo 1, and phasors to 1e-6 of their modulus, for phases up to 1000 radians and for moduli of 0 or 1e-18 to 1e18.

/// Computes the phase of each sample of a field, in cycles, 0 to 1.
void phases_of_plain(const std::complex<float>* field, std::span<float> cycles);
extern decltype(phases_of_plain)& phases_of;

/// Computes the phases φ ± acos|F| in cycles, 0 to 1, of a row of a checkerboard: `first_sign` is 1 if the first pixel
/// has the positive sign, or −1. Hsueh and Sawchuk, Applied Optics 17, 1978.
void double_phases_plain(const std::complex<float>* field, float first_sign, std::span<float> cycles);
extern decltype(double_phases_plain)& double_phases;

/// Computes e^{iφ} for phases in radians.
void phasors_plain(const float* phases, std::span<std::complex<float>> out);
extern decltype(phasors_plain)& phasors;

/// Gives each value its modulus of `moduli` and keeps its phase; the phase of 0 is 0.
void set_moduli_plain(const float* moduli, std::span<std::complex<float>> values);
extern decltype(set_moduli_plain)& set_moduli;

}  // namespace hogel::patterns
