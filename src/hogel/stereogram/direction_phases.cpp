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
    DirectionPhases all;
    for (std::size_t look = 0; look < options.looks; ++look) {
        Array<std::complex<float>, 2>& phases = all.emplace_back(shape);
        // Uses the series of a hogel outside the hologram, so that these phases differ from those of every hogel.
        spread_random_phases(phase_series(options, 0xffffffff, 0xffffffff, look), ones, phases.elements());
        if (flat) flatten_fringe(moduli, fft, phases);
    }
    return all;
}

void write_lines(const HologramOptions& options, const HogelKey& hogel, std::size_t lines,
                 std::span<const std::complex<float>> line, std::complex<float>* to, std::size_t to_row) {
    for (std::size_t i = lines; i-- > 0;) {
        const float one = 1;
        std::complex<float> phase;
        spread_random_phases(phase_series(options, 0xffffffff, hogel.t * lines + i, hogel.look), {&one, 1},
                             {&phase, 1});
        std::ranges::transform(line, to + i * to_row, [phase](std::complex<float> x) {
            // Without the tests for infinities of a product of std::complex.
            return std::complex<float>(x.real() * phase.real() - x.imag() * phase.imag(),
                                       x.real() * phase.imag() + x.imag() * phase.real());
        });
    }
}

}  // namespace hogel::stereogram
