// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/random_phase.h"

#include <algorithm>
#include <numbers>

#include "hogel/core/random.h"
#include "hogel/stereogram/random_bytes.h"

namespace hogel::stereogram {
namespace {

const std::array<std::complex<float>, 256>& roots_of_unity() {
    static const auto table = [] {
        std::array<std::complex<float>, 256> roots;
        for (std::size_t b = 0; b < roots.size(); ++b)
            roots[b] = std::complex<float>(std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(b) / 256));
        return roots;
    }();
    return table;
}

}  // namespace

void random_bytes_plain(const PhaseSeries& series, std::uint32_t first_draw, std::span<std::uint8_t> bytes) {
    for (std::size_t i = 0; i < bytes.size(); i += 16) {
        const auto words = core::philox({first_draw + static_cast<std::uint32_t>(i / 16), series.position[0],
                                         series.position[1], series.position[2]},
                                        series.key);
        for (std::size_t j = 0; j < std::min<std::size_t>(16, bytes.size() - i); ++j)
            bytes[i + j] = static_cast<std::uint8_t>(words[j / 4] >> (8 * (j % 4)));
    }
}

const PhaseRoots& phase_roots() {
    static const auto table = [] {
        PhaseRoots roots;
        for (std::size_t b = 0; b < 256; ++b) {
            const std::complex<float> root = roots_of_unity()[b];
            roots.re[b] = root.real();
            roots.im[b] = root.imag();
            if (b < 16) roots.lower_re[b] = root.real(), roots.lower_im[b] = root.imag();
            if (b % 16 == 0) roots.upper_re[b / 16] = root.real(), roots.upper_im[b / 16] = root.imag();
        }
        return roots;
    }();
    return table;
}

void spread_random_phases(const PhaseSeries& series, std::span<const float> moduli,
                          std::span<std::complex<float>> values, std::uint32_t first_draw) {
    const auto& roots = roots_of_unity();
    alignas(64) std::array<std::uint8_t, 1024> bytes;
    for (std::size_t i = 0; i < values.size(); i += bytes.size()) {
        const std::size_t n = std::min(bytes.size(), values.size() - i);
        random_bytes(series, first_draw + static_cast<std::uint32_t>(i / 16), std::span(bytes).first(n));
        const float* modulus = &moduli[i];
        std::complex<float>* value = &values[i];
        for (std::size_t j = 0; j < n; ++j) value[j] = modulus[j] * roots[bytes[j]];
    }
}

}  // namespace hogel::stereogram
