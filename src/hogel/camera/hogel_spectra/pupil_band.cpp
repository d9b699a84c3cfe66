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

// Relative widening of a pupil's band, because its width varies slightly over the hologram.
constexpr double guard = 0.1;

// Accuracy of a band: relative widening, tolerance, and out-of-band margin in waves per hogel.
struct Accuracy {
    double sampling_guard = guard, tolerance = 6e-4, margin = std::numeric_limits<double>::infinity();
};
constexpr Accuracy full_accuracy, preview_accuracy{0, 3e-2, 5};

// Frequencies in cycles per hogel, at the point of the hologram nearest to the viewpoint.
struct BandWidths {
    double pupil;  ///< half the width of the pupil's light
    double bend;   ///< increase of the demodulation's frequency over a hogel

    // Half the width of the light that `per_hogel` samples per hogel represent. The demodulation is taken at the nodes,
    // some of which lie beyond the hogel's ends.
    double half_width(std::size_t per_hogel) const {
        const double node_extent = 0.5 + 3 / static_cast<double>(per_hogel);
        return pupil * (1 + guard) + bend * node_extent + 0.5 / static_cast<double>(SlepianBasis::fractions);
    }
    // Returns enough samples for the film's interpolation, and to represent the light of a hogel.
    std::size_t per_hogel(const Accuracy& accuracy) const {
        std::size_t count = 1;
        while (static_cast<double>(count) <
               std::max(pupil * (1 + accuracy.sampling_guard) / camera::film::InterpolationTable::pass,
                        2.5 * half_width(count)))
            ++count;
        return count;
    }
};

// Returns the samples per hogel; the samples of a window are divided among the hogels that it covers.
std::size_t samples_per_hop(const BandWidths& widths, std::size_t overlap, const Accuracy& accuracy) {
    return (widths.per_hogel(accuracy) + overlap - 1) / overlap;
}

BandWidths band_widths(const Grid& plane, const HogelLayout& hogels, const camera::Viewpoint& viewpoint) {
    const double x =
        std::clamp(viewpoint.position.x, plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2);
    const double y =
        std::clamp(viewpoint.position.y, plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2);
    const double wavelength = hogels.grid.wavelength;
    const double path = wavelength * camera::ViewGeometry(viewpoint.position, wavelength).distance(x, y);
    const double side = plane.pitch_x * static_cast<double>(hogels.columns);
    return {0.5 * viewpoint.pupil * side / path, side * side / path};
}

}  // namespace

std::size_t band_samples_per_hogel(const HogelLayout& hogels, const camera::Viewpoint& viewpoint) {
    return samples_per_hop(band_widths(hogels.grid.plane, hogels, viewpoint), hogels.overlap,
                           viewpoint.preview ? preview_accuracy : full_accuracy);
}

std::vector<PupilBand> PupilBand::create(const HogelLayout& hogels, const HogelRange& range,
                                         std::span<const camera::Viewpoint> viewpoints) {
    const std::size_t across = hogels.across(), down = hogels.down();
    const Grid plane =
        hogel::part(hogels.grid.plane, {range.s0 * across, range.t0 * down, range.ns * across, range.nt * down});
    using Bases = std::pair<std::shared_ptr<const SlepianBasis>, std::shared_ptr<const SlepianBasis>>;
    std::map<std::tuple<std::size_t, double, bool>, Bases> cached_bases;
    std::vector<PupilBand> bands;
    for (const camera::Viewpoint& viewpoint : viewpoints) {
        const BandWidths widths = band_widths(plane, hogels, viewpoint);
        const Accuracy& accuracy = viewpoint.preview ? preview_accuracy : full_accuracy;
        const std::size_t per_hogel = samples_per_hop(widths, hogels.overlap, accuracy),
                          nodes = per_hogel * hogels.overlap;
        const double half_width = widths.half_width(nodes);
        if (!band_is_cheaper(per_hogel, hogels)) return {};
        Bases& bases = cached_bases[{per_hogel, half_width, viewpoint.preview}];
        if (!bases.first) {
            const auto basis = [&](std::size_t samples, std::size_t before) {
                return std::make_shared<const SlepianBasis>(samples, nodes, half_width, hogels.window, before,
                                                            accuracy.tolerance);
            };
            bases.first = basis(hogels.columns, 1);
            bases.second = hogels.rows == hogels.columns ? bases.first : basis(hogels.rows, bases.first->before());
            if (bases.second->before() > bases.first->before())
                bases.first = basis(hogels.columns, bases.second->before());
        }
        PupilBand band(camera::ViewGeometry(viewpoint.position, hogels.grid.wavelength));
        std::tie(band.across_, band.down_) = bases;
        band.per_hogel_ = per_hogel;
        band.overlap_ = hogels.overlap;
        band.bend_ = widths.bend;
        band.half_width_ = half_width + accuracy.margin;
        const auto step = [&](double pitch, std::size_t samples) {
            return pitch * (static_cast<double>(samples) / static_cast<double>(per_hogel));
        };
        band.grid_.plane = {band.samples(range.ns),    band.samples(range.nt), step(plane.pitch_x, across),
                            step(plane.pitch_y, down), plane.center_x,         plane.center_y};
        bands.push_back(std::move(band));
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
                         stereogram::InBandRows& range) {
        if (weights.first != nullptr && SlepianBasis::rounded(frequency) == weights.frequency) return;
        weights = basis.weights(frequency);
        range = in_band(weights.frequency, basis.samples());
    };
    set((x - geometry.eye().x) * width * cycles, *across_, view.columns, view.in_band_columns);
    set((geometry.eye().y - y) * height * cycles, *down_, view.rows, view.in_band_rows);
}

// Returns the waves m of n with |m + frequency| ≤ half_width_, modulo n.
stereogram::InBandRows PupilBand::in_band(double frequency, std::size_t waves) const {
    const auto n = static_cast<double>(waves);
    if (2 * half_width_ + 1 >= n) return {};
    const double first = std::ceil(-frequency - half_width_), count = std::floor(half_width_ - frequency) - first + 1;
    if (count >= n) return {};
    return {static_cast<std::size_t>(first - n * std::floor(first / n)), static_cast<std::size_t>(count)};
}

// Computes squares of samples: exactly along the two lines through the middle, elsewhere as the product of both times a
// bend ∂²r/∂x∂y that is nearly constant over the square.
void PupilBand::demodulation(std::size_t x0, std::size_t y0, View<float, 3> phases) const {
    const camera::ViewGeometry& geometry = grid_.geometry;
    const Grid& plane = grid_.plane;
    const double wavelength = geometry.wavelength(), frequency = 1 / wavelength, z = geometry.eye().z;
    constexpr double half_count = 0.5 * static_cast<double>(lanes);
    const double half_side = half_count * std::max(plane.pitch_x, plane.pitch_y);
    const std::size_t row_stride = phases.extent(2);
    for (std::size_t down = 0; down < phases.extent(0); down += lanes)
        for (std::size_t across = 0; across < row_stride; across += lanes) {
            const std::size_t rows = std::min(lanes, phases.extent(0) - down);
            const auto middle = [](std::size_t first) { return static_cast<double>(first) - sample_position(0); };
            const double middle_x = plane.x(middle(x0 + across)), middle_y = plane.y(middle(y0 + down));
            const double x = middle_x - geometry.eye().x, y = middle_y - geometry.eye().y;
            const double distance = geometry.distance(middle_x, middle_y);
            // ∂²r/∂x∂y = −n_x n_y/r, and rows run down.
            const double bend = x * y * plane.pitch_x * plane.pitch_y / (distance * distance * distance * wavelength);
            float* destination = &phases(down, 0, across);
            // Checks the next terms of the series, in cycles, and the angle that the polynomial of the phasor allows.
            if (half_side * half_side * half_side / (distance * distance * wavelength) < 2e-4 &&
                2 * std::numbers::pi * std::abs(bend) * half_count * half_count < 0.1) {
                hogel_spectra::demodulation({x, plane.pitch_x, y * y + z * z, frequency, distance * frequency},
                                            {y, -plane.pitch_y, x * x + z * z, frequency, 0}, bend, rows, destination,
                                            row_stride);
                continue;
            }
            for (std::size_t i = 0; i < rows; ++i)
                for (std::size_t j = 0; j < lanes; ++j) {
                    const std::complex<float> phase(optics::unit_phasor(geometry.cycles(
                        plane.x(static_cast<double>(x0 + across + j)), plane.y(static_cast<double>(y0 + down + i)))));
                    destination[2 * i * row_stride + j] = phase.real();
                    destination[(2 * i + 1) * row_stride + j] = phase.imag();
                }
        }
}

}  // namespace hogel::camera::hogel_spectra
