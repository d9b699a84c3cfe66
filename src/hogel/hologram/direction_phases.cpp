// SPDX-License-Identifier: Apache-2.0
#include "hogel/hologram/direction_phases.h"
#include "hogel/hologram/designed_phase.h"

namespace hogel::hologram {

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

}  // namespace hogel::hologram
