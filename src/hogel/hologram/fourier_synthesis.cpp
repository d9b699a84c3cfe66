#include <algorithm>
#include <cmath>

#include "hogel/hologram/direction_phases_internal.h"
#include "hogel/hologram/hogel_synthesis_internal.h"

namespace hogel {
namespace {

using Complex = std::complex<float>;

class FourierSynthesis final : public HogelSynthesis {
  public:
    FourierSynthesis(const LightFieldGrid& light_field, std::size_t samples, const StereogramOptions& options)
        : options_(options), frequencies_(light_field, samples, options.wavelength), fft_(samples, samples) {
        if (options.phases != Phases::random) directions_ = direction_phases(frequencies_, light_field, fft_, options);
    }

    std::size_t prepared_size() const override { return frequencies_.samples() * frequencies_.samples(); }

    void prepare(View<const float, 2> radiances, View<const float, 2>, View<float, 2> prepared) const override {
        if (options_.average == Average::radiance) return frequencies_.amplitudes(radiances, prepared);
        Array<float, 2> roots(radiances.shape());
        for (std::size_t i = 0; i < roots.size(); ++i) roots.data()[i] = std::sqrt(std::max(radiances.data()[i], 0.0f));
        frequencies_.amplitudes_of_roots(roots, prepared);
    }

    // Phases are counted from the hogel's first sample; the factor i of [K] (4.2) is part of them.
    void synthesise(std::span<const float> moduli, const HogelPlace& place, View<Complex, 2> hogel) const override {
        if (directions_.empty())
            spread_random_phases(phase_series(options_, place.s, place.t, place.look), moduli, hogel.elements());
        else
            for (std::size_t i = 0; i < moduli.size(); ++i)
                hogel.data()[i] = moduli[i] * directions_[place.look].data()[i];
        fft_.backward(hogel);
    }

  private:
    StereogramOptions options_;
    FrequencyGrid frequencies_;
    Fft2 fft_;
    DirectionPhases directions_;  // empty where every hogel has phases of its own
};

}  // namespace

std::unique_ptr<HogelSynthesis> make_fourier_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                       const StereogramOptions& options) {
    return std::make_unique<FourierSynthesis>(light_field, samples, options);
}

}  // namespace hogel
