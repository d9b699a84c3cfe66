// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <deque>

#include "hogel/error.h"
#include "hogel/stereogram/direction_phases.h"
#include "hogel/stereogram/fourier_synthesis.h"
#include "hogel/stereogram/hogel_synthesis.h"
#include "hogel/units.h"
#include "thesis/fringes/fringe_table.h"
#include "thesis/wavelets/transform.h"

namespace hogel::fringes {

using namespace stereogram;

namespace {

using Complex = std::complex<float>;

constexpr double max_bytes = 4.0 * (std::size_t{1} << 30);

// A hogel is a sum of fringes, one per basis function of a transform of the directions of a face, weighted with the
// coefficients of its amplitudes √L. With horizontal parallax only, a fringe is one line, and the lines of a hogel
// differ in a phase. Sources: [K] (3.24) and 4.2; Lucente 1994 for the piecewise constant basis, whose coefficients are
// the samples.
//
// Fringes are linear in the amplitudes. Therefore the waves of a hogel are computed from its amplitudes, the inverse
// transform of its coefficients.
class BasisSynthesis final : public HogelSynthesis {
  public:
    BasisSynthesis(std::span<const LightFieldGrid> faces, FrequencyGrid frequencies, std::size_t lines,
                   const HologramOptions& options, const Basis& method, RayValues values)
        : faces_(faces.begin(), faces.end()),
          options_(options),
          lines_(lines),
          values_(values),
          pieces_(method.transform == "pieces"),
          tolerance_(method.tolerance),
          transform_(wavelets::transform(pieces_ ? "haar" : method.transform)),
          frequencies_(std::move(frequencies)),
          fft_(frequencies_.rows(), frequencies_.columns()),
          phases_(direction_phases(frequencies_, fft_, options, method.phases == SharedPhases::designed)),
          waves_(*this) {
        const std::size_t rays = frequencies_.rays(), samples = frequencies_.coefficients();
        const double bytes = static_cast<double>(rays * samples * options.looks) * sizeof(Complex);
        if (bytes > max_bytes)
            throw Error(ErrorCode::usage,
                        fmt::format("basis fringes of {}x{} samples for {} directions take {}, more than {}; "
                                    "expected fewer directions or smaller hogels",
                                    frequencies_.columns(), frequencies_.rows(), rays, format_bytes(bytes),
                                    format_bytes(max_bytes)));
        const Shape<2> shape{frequencies_.rows(), frequencies_.columns()};
        for (std::size_t look = 0; look < options.looks; ++look)
            fringes_.emplace_back(rays, samples, [this, look, shape](std::size_t number, std::span<Complex> fringe) {
                make_fringe(number, look, {fringe.data(), shape});
            });
        if (tolerance_ > 0) {
            norms_.resize(rays);
            for (std::size_t i = 0; i < norms_.size(); ++i) {
                const Complex* fringe = fringes_[0][i];
                double sum = 0;
                for (std::size_t j = 0; j < samples; ++j) sum += std::norm(fringe[j]);
                norms_[i] = static_cast<float>(std::sqrt(sum));
            }
        }
    }

    std::size_t prepared_size() const override { return frequencies_.rays(); }

    void prepare(View<const float, 2> values, View<const float, 2>, View<float, 2> prepared) const override {
        if (values_ == RayValues::coefficients) {
            std::copy_n(values.data(), values.size(), prepared.data());
        } else {
            roots_of(values, prepared);
            if (!pieces_) transform_faces(prepared);
        }
        if (tolerance_ > 0)
            for (std::size_t hogel = 0; hogel < prepared.extent(0); ++hogel) drop_small(prepared[hogel].elements());
    }

    void synthesise(std::span<const float> coefficients, const HogelKey& key, View<Complex, 2> hogel) const override {
        std::vector<WeightedFringe> sum;
        for (std::size_t i = 0; i < coefficients.size(); ++i)
            if (coefficients[i] != 0) sum.push_back({fringes_[key.look][i], coefficients[i]});
        if (lines_ == 0) return sum_fringes(sum, hogel.elements());
        const std::span<Complex> line(hogel.data(), hogel.extent(1));
        sum_fringes(sum, line);
        write_lines(options_, key, lines_, line, hogel.data(), hogel.extent(1));
    }

    const HogelWaves* hogel_waves() const override { return &waves_; }

  private:
    class Waves final : public HogelWaves {
      public:
        explicit Waves(const BasisSynthesis& basis)
            : basis_(basis),
              fourier_(basis.frequencies_, basis.lines_, basis.options_, basis.phases_, LobeAverage::amplitude) {}
        std::size_t prepared_size() const override { return fourier_.prepared_size(); }
        void prepare(View<const float, 2> values, View<const float, 2> depths, View<float, 2> prepared) const override {
            Array<float, 2> amplitudes({values.extent(0), basis_.prepared_size()});
            // The complete coefficients of amplitudes yield these amplitudes.
            if (basis_.values_ == RayValues::radiance && basis_.tolerance_ == 0) {
                roots_of(values, amplitudes);
            } else {
                basis_.prepare(values, depths, amplitudes);
                if (!basis_.pieces_) basis_.transform_faces(amplitudes, false);
            }
            fourier_.prepare_roots(amplitudes, prepared);
        }
        void waves(std::span<const float> prepared, const HogelKey& key, const InBandRows& rows,
                   float* waves) const override {
            fourier_.waves(prepared, key, rows, waves);
        }

      private:
        const BasisSynthesis& basis_;
        FourierSynthesis fourier_;
    };

    // Returns the transform over the directions of a face, not over the hogels, for an array of some hogels.
    static wavelets::Pyramid pyramid(const LightFieldGrid& face, std::size_t hogels) {
        return wavelets::Pyramid::separate({hogels, face.directions_v, face.directions_u}, {{1, 2}});
    }

    // Transforms the amplitudes of some hogels into coefficients, face by face, or the reverse.
    void transform_faces(View<float, 2> values, bool forward = true) const {
        const std::size_t hogels = values.extent(0);
        const auto apply = [&](const LightFieldGrid& face, std::span<float> face_values) {
            if (forward)
                transform_.forward(pyramid(face, hogels), face_values);
            else
                transform_.inverse(pyramid(face, hogels), face_values);
        };
        if (faces_.size() == 1) return apply(faces_.front(), values.elements());
        std::size_t first = 0;
        for (const LightFieldGrid& face : faces_) {
            const std::size_t directions = face.directions();
            Array<float, 2> part({hogels, directions});
            for (std::size_t i = 0; i < hogels; ++i) std::copy_n(&values(i, first), directions, &part(i, 0));
            apply(face, part.elements());
            for (std::size_t i = 0; i < hogels; ++i) std::copy_n(&part(i, 0), directions, &values(i, first));
            first += directions;
        }
    }

    // Replaces a face's coefficients, including coefficient `number` of a hogel, by the face's amplitudes.
    void invert_face_of(std::size_t number, std::span<float> rays) const {
        std::size_t first = 0;
        for (const LightFieldGrid& face : faces_) {
            if (number < first + face.directions())
                return transform_.inverse(pyramid(face, 1), rays.subspan(first, face.directions()));
            first += face.directions();
        }
    }

    void make_fringe(std::size_t number, std::size_t look, View<Complex, 2> fringe) const {
        Array<float, 2> function({1, frequencies_.rays()}), moduli({1, fringe.size()});
        function.data()[number] = 1;
        if (!pieces_) invert_face_of(number, function.elements());
        frequencies_.amplitudes_of_roots(function, moduli);
        for (std::size_t i = 0; i < fringe.size(); ++i) fringe.data()[i] = moduli.data()[i] * phases_[look].data()[i];
        fft_.backward(fringe);
    }

    // Sets the smallest coefficients to zero, up to a fraction `tolerance` of the amplitude in total (exact for
    // orthogonal fringes). Finds them by a histogram in half octaves of energy instead of by sorting.
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

    std::vector<LightFieldGrid> faces_;
    HologramOptions options_;
    std::size_t lines_;  // per hogel, for horizontal parallax only; 0: a square with both parallaxes
    RayValues values_;
    bool pieces_;
    double tolerance_;
    wavelets::Transform transform_;
    FrequencyGrid frequencies_;
    math::Fft2 fft_;
    DirectionPhases phases_;
    Waves waves_;
    std::deque<FringeTable> fringes_;  // one per look
    std::vector<float> norms_;         // norms of the fringes; empty if no coefficients are dropped
};

}  // namespace
}  // namespace hogel::fringes

namespace hogel::stereogram {

std::unique_ptr<HogelSynthesis> make_basis_synthesis(std::span<const LightFieldGrid> faces, std::size_t samples,
                                                     std::size_t rows, const HologramOptions& options,
                                                     const Basis& method, RayValues values) {
    using fringes::BasisSynthesis;
    const double wavelength = options.channel.wavelength;
    const Interpolation between = method.transform == "pieces" ? Interpolation::constant : Interpolation::linear;
    if (method.line_pitch) {
        const double pitch = faces.front().pitch / static_cast<double>(rows);
        return std::make_unique<BasisSynthesis>(
            faces, FrequencyGrid::of_line(faces, samples, pitch, wavelength, between), rows, options, method, values);
    }
    return std::make_unique<BasisSynthesis>(faces,
                                            faces.size() == 1
                                                ? FrequencyGrid(faces.front(), samples, wavelength, between)
                                                : FrequencyGrid(faces, samples, wavelength, between),
                                            0, options, method, values);
}

}  // namespace hogel::stereogram
