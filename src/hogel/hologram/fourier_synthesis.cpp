#include "hogel/hologram/designed_phase.h"
#include "hogel/hologram/frequency_grid.h"
#include "hogel/hologram/hogel_synthesis_internal.h"
#include "hogel/hologram/random_phase.h"
#include "hogel/math/fft.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

class FourierSynthesis final : public HogelSynthesis {
  public:
    FourierSynthesis(const LightFieldGrid& light_field, std::size_t samples, const StereogramOptions& options)
        : options_(options), frequencies_(light_field, samples, options.wavelength), fft_(samples, samples) {
        if (options.phases == Phases::random) return;
        Array<float, 2> moduli({samples, samples});
        const std::vector<float> uniform(light_field.directions(), 1.0f);
        frequencies_.amplitudes(uniform, moduli.elements());
        // Hogels that do not exist give the directions their own phases.
        for (std::size_t look = 0; look < options.looks; ++look) {
            Array<Complex, 2>& phases = directions_.emplace_back(Shape<2>{samples, samples});
            const std::vector<float> ones(phases.size(), 1.0f);
            spread_random_phases(phases_of({0xffffffff, 0xffffffff, look}), ones, phases.elements());
            if (options.phases == Phases::designed) flatten_fringe(moduli, fft_, phases);
        }
    }

    std::size_t prepared_size() const override { return frequencies_.samples() * frequencies_.samples(); }

    void prepare(View<const float, 2> radiances, View<const float, 2>, View<float, 2> prepared) const override {
        frequencies_.amplitudes(radiances, prepared);
    }

    // Phases are counted from the hogel's first sample; the factor i of [K] (4.2) is part of them.
    void synthesise(std::span<const float> moduli, const HogelPlace& place, View<Complex, 2> hogel) const override {
        if (directions_.empty())
            spread_random_phases(phases_of(place), moduli, hogel.elements());
        else
            for (std::size_t i = 0; i < moduli.size(); ++i)
                hogel.data()[i] = moduli[i] * directions_[place.look].data()[i];
        fft_.backward(hogel);
    }

  private:
    PhaseSeries phases_of(const HogelPlace& place) const {
        return {{static_cast<std::uint32_t>(options_.seed), static_cast<std::uint32_t>(options_.seed >> 32)},
                {static_cast<std::uint32_t>(place.look * 4 + options_.channel), static_cast<std::uint32_t>(place.s),
                 static_cast<std::uint32_t>(place.t)}};
    }

    StereogramOptions options_;
    FrequencyGrid frequencies_;
    Fft2 fft_;
    std::vector<Array<Complex, 2>> directions_;  // for each look; empty where every hogel has phases of its own
};

}  // namespace

std::unique_ptr<HogelSynthesis> make_fourier_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                       const StereogramOptions& options) {
    return std::make_unique<FourierSynthesis>(light_field, samples, options);
}

}  // namespace hogel
