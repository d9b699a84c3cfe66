// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/direction_phases.h"

#include <algorithm>

#include "hogel/stereogram/designed_phase.h"

namespace hogel::stereogram {

PhaseSeries phase_series(const HologramOptions& options, std::size_t s, std::size_t t, std::size_t look) {
    return {{static_cast<std::uint32_t>(options.seed), static_cast<std::uint32_t>(options.seed >> 32)},
            {static_cast<std::uint32_t>(look * 4 + options.channel.index), static_cast<std::uint32_t>(s),
             static_cast<std::uint32_t>(t)}};
}

DirectionPhases direction_phases(const FrequencyGrid& frequencies, const math::Fft2& fft,
                                 const HologramOptions& options, bool flat) {
    const Shape<2> shape{frequencies.rows(), frequencies.columns()};
    Array<float, 2> moduli(shape);
    const std::vector<float> uniform(frequencies.rays(), 1.0f), ones(moduli.size(), 1.0f);
    frequencies.amplitudes(uniform, moduli.elements());
    DirectionPhases phases_by_look;
    for (std::size_t look = 0; look < options.looks; ++look) {
        Array<std::complex<float>, 2>& phases = phases_by_look.emplace_back(shape);
        // A hogel index outside the hologram keeps these phases apart from those of every hogel.
        spread_random_phases(phase_series(options, 0xffffffff, 0xffffffff, look), ones, phases.elements());
        if (flat) flatten_fringe(moduli, fft, phases);
    }
    return phases_by_look;
}

void write_lines(const HologramOptions& options, const HogelKey& hogel, std::size_t lines,
                 std::span<const std::complex<float>> line, std::complex<float>* to, std::size_t to_stride) {
    for (std::size_t i = lines; i-- > 0;) {
        const float modulus = 1;
        std::complex<float> phase;
        spread_random_phases(phase_series(options, 0xffffffff, hogel.t * lines + i, hogel.look), {&modulus, 1},
                             {&phase, 1});
        std::ranges::transform(line, to + i * to_stride, [phase](std::complex<float> x) {
            // A product of std::complex would test for infinities.
            return std::complex<float>(x.real() * phase.real() - x.imag() * phase.imag(),
                                       x.real() * phase.imag() + x.imag() * phase.real());
        });
    }
}

}  // namespace hogel::stereogram
