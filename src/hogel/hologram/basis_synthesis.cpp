// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <deque>

#include "hogel/error.h"
#include "hogel/hologram/direction_phases.h"
#include "hogel/hologram/fringe_table.h"
#include "hogel/hologram/hogel_synthesis.h"
#include "hogel/transform/transform.h"
#include "hogel/units.h"

namespace hogel::hologram {
namespace {

using Complex = std::complex<float>;

constexpr double max_bytes = 4.0 * (std::size_t{1} << 30);

// A hogel is a sum of fringes, one for each basis function of a transform of the directions, weighted with the
// coefficients of its amplitudes √L. Sources: [K] (3.24) and 4.2; Lucente 1994 for the piecewise constant basis, whose
// coefficients are the samples.
class BasisSynthesis final : public HogelSynthesis {
  public:
    BasisSynthesis(const LightFieldGrid& light_field, std::size_t samples, const HologramOptions& options,
                   const Basis& method, RayValues values)
        : light_field_(light_field),
          values_(values),
          pieces_(method.transform == "pieces"),
          tolerance_(method.tolerance),
          transform_(hogel::transform::transform(pieces_ ? "haar" : method.transform)),
          frequencies_(light_field, samples, options.channel.wavelength,
                       pieces_ ? Interpolation::constant : Interpolation::linear),
          fft_(samples, samples),
          phases_(direction_phases(frequencies_, fft_, options, method.phases == SharedPhases::designed)) {
        const double bytes =
            static_cast<double>(light_field.directions() * samples * samples * options.looks) * sizeof(Complex);
        if (bytes > max_bytes)
            throw Error(ErrorCode::usage,
                        fmt::format("basis fringes of {0}x{0} samples for {1}x{2} directions take {3}, more than {4}; "
                                    "expected fewer directions or smaller hogels",
                                    samples, light_field.directions_u, light_field.directions_v, format_bytes(bytes),
                                    format_bytes(max_bytes)));
        for (std::size_t look = 0; look < options.looks; ++look)
            fringes_.emplace_back(light_field.directions(), samples * samples,
                                  [this, look, samples](std::size_t number, std::span<Complex> fringe) {
                                      make_fringe(number, look, {fringe.data(), {samples, samples}});
                                  });
        if (tolerance_ > 0) {
            norms_.resize(light_field.directions());
            for (std::size_t i = 0; i < norms_.size(); ++i) {
                const Complex* fringe = fringes_[0][i];
                double sum = 0;
                for (std::size_t j = 0; j < samples * samples; ++j) sum += std::norm(fringe[j]);
                norms_[i] = static_cast<float>(std::sqrt(sum));
            }
        }
    }

    std::size_t prepared_size() const override { return light_field_.directions(); }

    void prepare(View<const float, 2> values, View<const float, 2>, View<float, 2> prepared) const override {
        if (values_ == RayValues::coefficients) {
            std::copy_n(values.data(), values.size(), prepared.data());
        } else {
            for (std::size_t i = 0; i < values.size(); ++i)
                prepared.data()[i] = std::sqrt(std::max(values.data()[i], 0.0f));
            if (!pieces_) transform_.forward(pyramid(values.extent(0)), prepared.elements());
        }
        if (tolerance_ > 0)
            for (std::size_t hogel = 0; hogel < prepared.extent(0); ++hogel) drop_small(prepared[hogel].elements());
    }

    void synthesise(std::span<const float> coefficients, const HogelPlace& place,
                    View<Complex, 2> hogel) const override {
        std::vector<WeightedFringe> sum;
        for (std::size_t i = 0; i < coefficients.size(); ++i)
            if (coefficients[i] != 0) sum.push_back({fringes_[place.look][i], coefficients[i]});
        sum_fringes(sum, hogel.elements());
    }

  private:
    // The transform of the directions, without the hogels, for some hogels at once.
    transform::Pyramid pyramid(std::size_t hogels) const {
        return transform::Pyramid::separate({hogels, light_field_.directions_v, light_field_.directions_u}, {{1, 2}});
    }

    void make_fringe(std::size_t number, std::size_t look, View<Complex, 2> fringe) const {
        Array<float, 2> function({1, light_field_.directions()}), moduli({1, fringe.size()});
        function.data()[number] = 1;
        if (!pieces_) transform_.inverse(pyramid(1), function.elements());
        frequencies_.amplitudes_of_roots(function, moduli);
        for (std::size_t i = 0; i < fringe.size(); ++i) fringe.data()[i] = moduli.data()[i] * phases_[look].data()[i];
        fft_.backward(fringe);
    }

    // Sets the smallest coefficients to zero, as many as together carry the share `tolerance` of the amplitude (exactly
    // so if the fringes were orthogonal). They are found by a histogram in half octaves of energy instead of by
    // sorting.
    void drop_small(std::span<float> coefficients) const {
        const auto half_octave = [](float energy) { return std::bit_cast<std::uint32_t>(energy) >> 22; };
        const auto energy_of = [&](std::size_t i) {
            const float length = coefficients[i] * norms_[i];
            return length * length;
        };
        std::array<double, 512> energies{};
        double energy = 0;
        for (std::size_t i = 0; i < coefficients.size(); ++i) energies[half_octave(energy_of(i))] += energy_of(i);
        for (const double part : energies) energy += part;
        double left = tolerance_ * tolerance_ * energy;
        std::size_t dropped = 0;
        while (dropped < energies.size() && (left -= energies[dropped]) >= 0) ++dropped;
        for (std::size_t i = 0; i < coefficients.size(); ++i)
            if (half_octave(energy_of(i)) < dropped) coefficients[i] = 0;
    }

    LightFieldGrid light_field_;
    RayValues values_;
    bool pieces_;
    double tolerance_;
    transform::Transform transform_;
    FrequencyGrid frequencies_;
    math::Fft2 fft_;
    DirectionPhases phases_;
    std::deque<FringeTable> fringes_;  // one per look
    std::vector<float> norms_;         // of the fringes; empty if no coefficients are dropped
};

}  // namespace

std::unique_ptr<HogelSynthesis> make_basis_synthesis(const LightFieldGrid& light_field, std::size_t samples,
                                                     const HologramOptions& options, const Basis& method,
                                                     RayValues values) {
    return std::make_unique<BasisSynthesis>(light_field, samples, options, method, values);
}

}  // namespace hogel::hologram
