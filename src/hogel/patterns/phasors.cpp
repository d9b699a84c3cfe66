// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/phasors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogel::patterns {

void phases_of_plain(const std::complex<float>* field, std::span<float> cycles) {
    for (std::size_t x = 0; x < cycles.size(); ++x) {
        const float phase = std::arg(field[x]) * static_cast<float>(0.5 / std::numbers::pi);
        cycles[x] = phase < 0 ? phase + 1 : phase;
    }
}

void double_phases_plain(const std::complex<float>* field, float first_sign, std::span<float> cycles) {
    phases_of_plain(field, cycles);
    for (std::size_t x = 0; x < cycles.size(); ++x) {
        const auto half_angle =
            static_cast<float>(std::acos(std::min(1.0f, std::abs(field[x]))) * (0.5 / std::numbers::pi));
        cycles[x] += x % 2 == 0 ? first_sign * half_angle : -first_sign * half_angle;
        cycles[x] -= std::floor(cycles[x]);
    }
}

void phasors_plain(const float* phases, std::span<std::complex<float>> out) {
    for (std::size_t x = 0; x < out.size(); ++x) out[x] = std::polar(1.0f, phases[x]);
}

void set_moduli_plain(const float* moduli, std::span<std::complex<float>> values) {
    for (std::size_t x = 0; x < values.size(); ++x) {
        const float modulus = std::abs(values[x]);
        values[x] = modulus > 0 ? moduli[x] * (values[x] / modulus) : std::complex<float>(moduli[x]);
    }
}

}  // namespace hogel::patterns
