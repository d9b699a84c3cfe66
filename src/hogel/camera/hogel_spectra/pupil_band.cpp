// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/hogel_spectra/pupil_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "hogel/camera/film/interpolation.h"
#include "hogel/camera/hogel_spectra/demodulation.h"
#include "hogel/optics/phase_walk.h"

namespace hogel::camera::hogel_spectra {
namespace {

// A fraction by which a pupil's band is widened, because its width varies slightly over the hologram.
constexpr double guard = 0.1;

// How exact the light of an eye is. A preview takes only waves so near to the pupil's band, on either side of it, in
// waves to a hogel, and fewer functions and samples.
struct Exactness {
    double guard_of_samples = guard, tolerance = 6e-4, near = std::numeric_limits<double>::infinity();
};
constexpr Exactness whole_light, of_preview{0, 3e-2, 5};

// Bands of frequencies, in cycles per hogel, where the hologram is nearest to the eye.
struct Bands {
    double pupil;  ///< half the width of the pupil's light
    double bend;   ///< by how much the demodulation's frequency grows over a hogel

    // Half the width of the light that `per_hogel` samples to a hogel hold: the demodulation is that at the nodes, some
    // of which are beyond the hogel's ends.
    double held(std::size_t per_hogel) const {
        const double reach = 0.5 + 3 / static_cast<double>(per_hogel);
        return pupil * (1 + guard) + bend * reach + 0.5 / static_cast<double>(SlepianBasis::fractions);
    }
    // Enough for the film's interpolation to pass the pupil's light, and for samples to hold a hogel's.
    std::size_t per_hogel(const Exactness& light) const {
        std::size_t count = 1;
        while (
            static_cast<double>(count) <
            std::max(pupil * (1 + light.guard_of_samples) / camera::film::InterpolationTable::pass, 2.5 * held(count)))
            ++count;
        return count;
    }
};

// Hogels of windows take as many samples each.
std::size_t per_hop(const Bands& bands, std::size_t overlap, const Exactness& light) {
    return (bands.per_hogel(light) + overlap - 1) / overlap;
}

Bands bands_of(const Grid& plane, const HogelLayout& hogels, const camera::Viewpoint& eye) {
    const double x =
        std::clamp(eye.position.x, plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2);
    const double y =
        std::clamp(eye.position.y, plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2);
    const double wavelength = hogels.grid.wavelength;
    const double path = wavelength * camera::ViewGeometry(eye.position, wavelength).distance(x, y);
    const double side = plane.pitch_x * static_cast<double>(hogels.columns);
    return {0.5 * eye.pupil * side / path, side * side / path};
}

}  // namespace

std::size_t band_samples_per_hogel(const HogelLayout& hogels, const camera::Viewpoint& eye) {
    return per_hop(bands_of(hogels.grid.plane, hogels, eye), hogels.overlap, eye.preview ? of_preview : whole_light);
}

std::vector<PupilBand> PupilBand::of(const HogelLayout& hogels, const HogelRange& range,
                                     std::span<const camera::Viewpoint> eyes) {
    const std::size_t across = hogels.across(), down = hogels.down();
    const Grid whole =
        hogel::part(hogels.grid.plane, {range.s0 * across, range.t0 * down, range.ns * across, range.nt * down});
    using Bases = std::pair<std::shared_ptr<const SlepianBasis>, std::shared_ptr<const SlepianBasis>>;
    std::map<std::tuple<std::size_t, double, bool>, Bases> known;
    std::vector<PupilBand> bands;
    for (const camera::Viewpoint& eye : eyes) {
        const Bands band = bands_of(whole, hogels, eye);
        const Exactness& light = eye.preview ? of_preview : whole_light;
        const std::size_t per_hogel = per_hop(band, hogels.overlap, light), nodes = per_hogel * hogels.overlap;
        const double half = band.held(nodes);
        if (!band_is_cheaper(per_hogel, hogels)) return {};
        Bases& bases = known[{per_hogel, half, eye.preview}];
        if (!bases.first) {
            const auto basis = [&](std::size_t samples, std::size_t before) {
                return std::make_shared<const SlepianBasis>(samples, nodes, half, hogels.window, before,
                                                            light.tolerance);
            };
            bases.first = basis(hogels.columns, 1);
            bases.second = hogels.rows == hogels.columns ? bases.first : basis(hogels.rows, bases.first->before());
            if (bases.second->before() > bases.first->before())
                bases.first = basis(hogels.columns, bases.second->before());
        }
        PupilBand own(camera::ViewGeometry(eye.position, hogels.grid.wavelength));
        std::tie(own.across_, own.down_) = bases;
        own.per_hogel_ = per_hogel;
        own.overlap_ = hogels.overlap;
        own.bend_ = band.bend;
        own.reach_ = half + light.near;
        const auto step = [&](double pitch, std::size_t samples) {
            return pitch * (static_cast<double>(samples) / static_cast<double>(per_hogel));
        };
        own.grid_.plane = {own.samples(range.ns),     own.samples(range.nt), step(whole.pitch_x, across),
                           step(whole.pitch_y, down), whole.center_x,        whole.center_y};
        bands.push_back(std::move(own));
    }
    return bands;
}

void PupilBand::view(const HogelLayout& hogels, std::size_t s, std::size_t t, HogelView& view) const {
    const camera::ViewGeometry& geometry = grid_.geometry;
    const Grid& plane = hogels.grid.plane;
    const auto middle = [](std::size_t hogel, std::size_t samples) {
        return (static_cast<double>(hogel) + 0.5) * static_cast<double>(samples) - 0.5;
    };
    const double x = plane.x(middle(s, hogels.across())), y = plane.y(middle(t, hogels.down()));
    const double width = static_cast<double>(hogels.columns) * plane.pitch_x,
                 height = static_cast<double>(hogels.rows) * plane.pitch_y, wavelength = geometry.wavelength();
    const double cycles = 1 / (geometry.distance(x, y) * wavelength);
    const auto set = [&](double frequency, const SlepianBasis& basis, SlepianBasis::Weights& weights,
                         stereogram::InBandRows& near_ones) {
        if (weights.first != nullptr && SlepianBasis::rounded(frequency) == weights.frequency) return;
        weights = basis.weights(frequency);
        near_ones = near(weights.frequency, basis.samples());
    };
    set((x - geometry.eye().x) * width * cycles, *across_, view.columns, view.in_band_columns);
    set((geometry.eye().y - y) * height * cycles, *down_, view.rows, view.near);
}

// The waves m of n with |m + frequency| ≤ reach, modulo n.
stereogram::InBandRows PupilBand::near(double frequency, std::size_t waves) const {
    const auto n = static_cast<double>(waves);
    if (2 * reach_ + 1 >= n) return {};
    const double first = std::ceil(-frequency - reach_), count = std::floor(reach_ - frequency) - first + 1;
    if (count >= n) return {};
    return {static_cast<std::size_t>(first - n * std::floor(first / n)), static_cast<std::size_t>(count)};
}

// Squares of samples. Exact along the two lines through the middle of each; elsewhere the product of both, times a bend
// that is nearly the same for all its samples: ∂²r/∂x∂y.
void PupilBand::demodulation(std::size_t x0, std::size_t y0, View<float, 3> phases) const {
    const camera::ViewGeometry& geometry = grid_.geometry;
    const Grid& plane = grid_.plane;
    const double wavelength = geometry.wavelength(), frequency = 1 / wavelength, z = geometry.eye().z;
    constexpr double reach = 0.5 * static_cast<double>(lanes);
    const double size = reach * std::max(plane.pitch_x, plane.pitch_y);
    const std::size_t row = phases.extent(2);
    for (std::size_t down = 0; down < phases.extent(0); down += lanes)
        for (std::size_t across = 0; across < row; across += lanes) {
            const std::size_t rows = std::min(lanes, phases.extent(0) - down);
            const auto middle = [](std::size_t first) { return static_cast<double>(first) - sample_place(0); };
            const double at_x = plane.x(middle(x0 + across)), at_y = plane.y(middle(y0 + down));
            const double x = at_x - geometry.eye().x, y = at_y - geometry.eye().y;
            const double distance = geometry.distance(at_x, at_y);
            // r grows by −n_x n_y/r along both axes, and rows run down.
            const double bend = x * y * plane.pitch_x * plane.pitch_y / (distance * distance * distance * wavelength);
            float* to = &phases(down, 0, across);
            // The next terms of the series, in cycles, and the angle up to which its root is exact.
            if (size * size * size / (distance * distance * wavelength) < 2e-4 &&
                2 * std::numbers::pi * std::abs(bend) * reach * reach < 0.1) {
                hogel_spectra::demodulation({x, plane.pitch_x, y * y + z * z, frequency, distance * frequency},
                                            {y, -plane.pitch_y, x * x + z * z, frequency, 0}, bend, rows, to, row);
                continue;
            }
            for (std::size_t i = 0; i < rows; ++i)
                for (std::size_t j = 0; j < lanes; ++j) {
                    const std::complex<float> phase(optics::unit_phasor(geometry.cycles(
                        plane.x(static_cast<double>(x0 + across + j)), plane.y(static_cast<double>(y0 + down + i)))));
                    to[2 * i * row + j] = phase.real();
                    to[(2 * i + 1) * row + j] = phase.imag();
                }
        }
}

}  // namespace hogel::camera::hogel_spectra
