// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/speckle_free/psf_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "hogel/camera/dirichlet.h"
#include "hogel/camera/film/lens.h"
#include "hogel/camera/sine_grid.h"
#include "hogel/camera/speckle_free/kernels.h"
#include "hogel/camera/view_geometry.h"
#include "hogel/math/fft.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/optics/pupil_edge.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::speckle_free {
namespace {

using std::numbers::pi;

using Complex = std::complex<float>;

// Pairs that send less than this share of the strongest pair's light into the pupil are left out.
constexpr double min_share = 1e-4;

// Beside a hogel and its blur, the resolution cells up to which a spot is followed, and those over which it fades out
// before its samples repeat.
constexpr double cells_followed = 5, cells_fading = 8;

// The width of the blur of a point of the hologram, in hogels.
double blur_width(const HogelGrid& hogels, const Camera& camera) {
    const double beside = std::hypot(camera.picture.center_x - camera.eye.x, camera.picture.center_y - camera.eye.y);
    const double distance = std::hypot(beside, camera.eye.z), cosine = camera.eye.z / distance;
    return defocus_blur(camera) * distance / cosine / hogels.plane.pitch_x;
}

// The pupil at one point of the hologram, by frequencies of the demodulated light in cycles per hogel.
class Pupil {
  public:
    Pupil(const HogelGrid& hogels, const Camera& camera, double x, double y)
        : camera_(camera),
          wavelength_(hogels.wavelength),
          step_(hogels.wavelength / hogels.plane.pitch_x),
          ratio_(focus_ratio(camera, x, y)) {
        const ViewGeometry geometry(camera.eye, wavelength_);
        nx_ = geometry.sine_x(x, y);
        ny_ = geometry.sine_y(x, y);
        cosine_ = geometry.cosine(x, y);
    }

    struct Transmission {
        double inside;               // distance from the rim, in cycles per hogel
        std::complex<double> phase;  // of the focus, times the density of frequencies
    };
    // Light that leaves the hogel in direction m = λf − n meets the plane of the pupil at δ. Rows run down.
    Transmission at(double across, double down) const {
        const double mx = step_ * across - nx_, my = -step_ * down - ny_, square = 1 - mx * mx - my * my;
        if (square <= 0) return {-1e9, 0};
        const double cosine = std::sqrt(square), z = camera_.eye.z;
        const double dx = z * (mx / cosine + nx_ / cosine_), dy = z * (my / cosine + ny_ / cosine_);
        const double radius = std::hypot(dx, dy), frequency = std::hypot(across, down);
        // Metres of the pupil per cycle along this line from its middle.
        const double scale = frequency > 0 ? radius / frequency : 1;
        const double inside = (0.5 * camera_.pupil - radius) / scale;
        const double cycles =
            ratio_ == 1 ? 0
                        : (film::path(nx_, ny_, z, dx, dy) - film::path(nx_, ny_, ratio_ * z, dx, dy)) / wavelength_;
        return {inside, cosine_ * cosine_ / square * optics::unit_phasor(cycles)};
    }

    // Radiance per intensity on the film: r² / (cos θ · area of the pupil).
    double radiance() const {
        const double distance = camera_.eye.z / cosine_;
        return distance * distance / (cosine_ * 0.25 * pi * camera_.pupil * camera_.pupil);
    }
    // By how much the demodulation's frequency grows over a hogel, in cycles, across and down.
    double bend_x(double pitch) const {
        return pitch * pitch * (1 - nx_ * nx_) * cosine_ / (camera_.eye.z * wavelength_);
    }
    double bend_y(double pitch) const {
        return pitch * pitch * (1 - ny_ * ny_) * cosine_ / (camera_.eye.z * wavelength_);
    }

  private:
    const Camera& camera_;
    double wavelength_, step_, ratio_, nx_ = 0, ny_ = 0, cosine_ = 1;
};

// Σ_j e^{2πi(y−κ)(j−c)/n + πi bend ((j−c)/n)²}/n: dirichlet() for a hogel over which the demodulation bends.
std::complex<double> bent_dirichlet(double y, std::size_t samples, double bend) {
    const auto n = static_cast<double>(samples);
    if (std::abs(bend) < 1e-3) return dirichlet(y, samples) / n;
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < samples; ++j) {
        const double place = (static_cast<double>(j) - 0.5 * (n - 1)) / n;
        sum += optics::unit_phasor(y * place + 0.5 * bend * place * place);
    }
    return sum / n;
}

// [q][κ = −half … half, in steps of 1/period]: the light of each wave of a basis.
Array<Complex, 2> lights(const PsfBasis& basis, std::size_t half, double period, double bend) {
    Array<Complex, 2> values({basis.count(), 2 * half + 1});
    for (std::size_t q = 0; q < basis.count(); ++q)
        for (std::size_t i = 0; i < 2 * half + 1; ++i) {
            const double kappa = (static_cast<double>(i) - static_cast<double>(half)) / period;
            values(q, i) = Complex(bent_dirichlet(basis.node(q) - kappa, basis.samples(), bend));
        }
    return values;
}

// [place · tap][sample]: the mean over a pixel at each place from a hogel of an intensity with these samples over a
// period, of which sample 0 is at the hogel. Exact for an intensity with frequencies up to `highest` / period.
// With r = e^{2πi/samples} sample k of a wave of frequency f is r^{fk}.
Array<float, 2> pixel_means(const PixelOffsets& places, std::size_t reach, std::size_t samples, double period,
                            std::size_t highest) {
    const std::size_t taps = 2 * reach + 1;
    Array<float, 2> means({places.places.size() * taps, samples});
    std::vector<std::complex<double>> roots(samples);
    for (std::size_t i = 0; i < samples; ++i)
        roots[i] = optics::unit_phasor(static_cast<double>(i) / static_cast<double>(samples));
    work::parallel_for(means.extent(0), [&](std::size_t row) {
        const double hogel = static_cast<double>(row % taps) - static_cast<double>(reach);
        const auto [offset, width] = places.places[row / taps];
        const double from = offset - hogel;
        std::vector<std::complex<double>> waves(highest);  // at the pixel, averaged over it
        for (std::size_t f = 1; f <= highest; ++f) {
            const double frequency = static_cast<double>(f) / period, turn = pi * frequency * width;
            waves[f - 1] = 2 * (turn > 0 ? std::sin(turn) / turn : 1) * optics::unit_phasor(frequency * from);
        }
        for (std::size_t k = 0; k < samples; ++k) {
            double sum = 1;
            for (std::size_t f = 1, power = k; f <= highest; ++f) {
                sum += waves[f - 1].real() * roots[power].real() + waves[f - 1].imag() * roots[power].imag();
                power = power + k < samples ? power + k : power + k - samples;
            }
            means(row, k) = static_cast<float>(sum / static_cast<double>(samples));
        }
    });
    return means;
}

}  // namespace

double half_band(const HogelGrid& hogels, Vec3 eye, double pupil) {
    const Grid& plane = hogels.plane;
    const double x = std::clamp(eye.x, plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2);
    const double y = std::clamp(eye.y, plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2);
    const double path = hogels.wavelength * ViewGeometry(eye, hogels.wavelength).distance(x, y);
    return 0.5 * pupil * plane.pitch_x / path;
}

Pairs::Pairs(const PsfNodes& basis, double half_band) : of_column(basis.count()) {
    constexpr std::size_t points = 32;
    const std::size_t nodes = basis.count();
    Array<double, 2> squares({nodes, points}), light({nodes, nodes});
    const auto place = [&](std::size_t i) {
        return half_band * (2 * (static_cast<double>(i) + 0.5) / double{points} - 1);
    };
    for (std::size_t q = 0; q < nodes; ++q)
        for (std::size_t i = 0; i < points; ++i) {
            const double value = dirichlet(basis.node(q) - place(i), basis.samples());
            squares(q, i) = value * value;
        }
    double strongest = 0;
    for (std::size_t x = 0; x < nodes; ++x) {
        std::array<double, points> across{};  // summed over the part of the disc at each place down
        for (std::size_t j = 0; j < points; ++j)
            for (std::size_t i = 0; i < points; ++i)
                if (std::hypot(place(i), place(j)) < half_band) across[j] += squares(x, i);
        for (std::size_t y = 0; y < nodes; ++y) {
            for (std::size_t j = 0; j < points; ++j) light(x, y) += across[j] * squares(y, j);
            strongest = std::max(strongest, light(x, y));
        }
    }
    for (std::size_t x = 0; x < nodes; ++x) {
        Range& range = of_column[x];
        while (range.begin < nodes && light(x, range.begin) < min_share * strongest) ++range.begin;
        range.end = nodes;
        while (range.end > range.begin && light(x, range.end - 1) < min_share * strongest) --range.end;
        count += range.end - range.begin;
    }
}

std::size_t max_places(const Pairs& pairs, std::size_t reach) {
    constexpr double max_bytes = 64e6;
    const auto taps = static_cast<double>(2 * reach + 1);
    const double bytes = taps * taps * static_cast<double>(pairs.padded_count() * sizeof(float));
    return static_cast<std::size_t>(std::clamp(std::sqrt(max_bytes / bytes), 4.0, 32.0));
}

PixelOffsets pixel_offsets(std::size_t pixels, double first, double step, std::size_t hogels, std::size_t beside,
                           std::size_t max_places) {
    PixelOffsets all;
    const double begin = -0.5 - static_cast<double>(beside), end = static_cast<double>(hogels + beside) - 0.5;
    for (const bool rounded : {false, true}) {
        all = {{}, {}, {}, {}, step, beside};
        for (std::size_t i = 0; i < pixels; ++i) {
            const double u = first + static_cast<double>(i) * step;
            const double low = std::clamp(u - 0.5 * step, begin, end), high = std::clamp(u + 0.5 * step, begin, end);
            const double middle = 0.5 * (low + high), base = std::floor(middle + 0.5);
            PixelOffsets::Place place{middle - base, high - low};
            const auto parts = static_cast<double>(max_places);
            if (rounded) place.offset = std::round(place.offset * parts) / parts;
            const auto same = std::ranges::find_if(all.places, [&](const PixelOffsets::Place& other) {
                return std::abs(other.offset - place.offset) < 1e-5 && std::abs(other.width - place.width) < 1e-5;
            });
            all.place.push_back(static_cast<std::size_t>(same - all.places.begin()));
            if (same == all.places.end()) all.places.push_back(place);
            all.base.push_back(static_cast<std::ptrdiff_t>(base));
            all.seen.push_back(static_cast<float>(place.width / step));
        }
        // Three more are those of pixels across the rims and beside them.
        if (all.places.size() <= max_places + 3) break;
    }
    return all;
}

std::size_t PsfTable::reach(const HogelGrid& hogels, const Camera& camera, double half_band) {
    const double pixel = std::max(camera.picture.pitch_x, camera.picture.pitch_y) / hogels.plane.pitch_x;
    const double cell = 0.5 / half_band;
    return static_cast<std::size_t>(
        std::ceil(0.5 + 0.5 * blur_width(hogels, camera) + cells_followed * cell + 0.5 * pixel));
}

namespace {

// The film of a spot: its period in hogels, and the pupil's samples that reach it.
struct PsfFilm {
    optics::SpreadWindow window{0, 0, 0, 1};
    double period = 0;
    std::size_t half = 0, size = 0;

    PsfFilm(const Camera& camera, double half_band, std::size_t reach, double pixel) {
        // Up to `reach` light is exact; it ends before the next period's light begins to be followed.
        window.flat = static_cast<double>(reach) + 0.5;
        window.stop = window.flat + pixel + cells_fading * 0.5 / half_band;
        period = window.flat + window.stop;
        const double radius = film::frequency_radius(2 * half_band, 2 * half_band * camera.eye.z / camera.pupil);
        half = static_cast<std::size_t>(std::ceil((radius + optics::PupilEdge(window, 1).reach()) * period));
        size = math::good_fft_size(4 * half + 2);
    }
};

// The pupil's samples of κ = −half … half, in steps of 1/period, [down][across].
struct Opening {
    Array<Complex, 2> wave;
    Array<float, 2> energy;  // of a sample on the rim, that of the part of its cell that is in the disc

    Opening(const Pupil& pupil, const optics::PupilEdge& edge, std::size_t half, double period)
        : wave({2 * half + 1, 2 * half + 1}), energy(wave.shape()) {
        const auto kappa = [&](std::size_t i) { return (static_cast<double>(i) - static_cast<double>(half)) / period; };
        for (std::size_t row = 0; row < wave.extent(0); ++row)
            for (std::size_t column = 0; column < wave.extent(1); ++column) {
                const auto [inside, phase] = pupil.at(kappa(column), kappa(row));
                wave(row, column) = Complex(edge.transmission(inside) * phase);
                energy(row, column) =
                    static_cast<float>(std::clamp(0.5 + inside * period, 0.0, 1.0) * std::norm(phase));
            }
    }

    // [wave][row]: the light of each wave across that passes through a row of the pupil.
    Array<float, 2> passing(View<const Complex, 2> across) const {
        const std::size_t side = wave.extent(0);
        Array<float, 2> light({across.extent(0), side});
        std::vector<float> powers(side);
        for (std::size_t q = 0; q < across.extent(0); ++q) {
            for (std::size_t i = 0; i < side; ++i) powers[i] = std::norm(across(q, i));
            for (std::size_t row = 0; row < side; ++row)
                light(q, row) = sum_products(powers.data(), &energy(row, 0), side);
        }
        return light;
    }

    // The light of a wave across and one down in the pupil, in the order of a transform of film's size.
    void fill(const Complex* across, const Complex* down, float scale, View<Complex, 2> film) const {
        const std::size_t side = wave.extent(0), half = side / 2, size = film.extent(0);
        for (std::size_t row = 0; row < side; ++row) {
            const Complex along = scale * down[row], *passed = &wave(row, 0);
            Complex* const line = &film((row + size - half) % size, 0);
            for (std::size_t i = 0; i < half; ++i)
                line[size - half + i] = optics::times(along, optics::times(across[i], passed[i]));
            for (std::size_t i = half; i < side; ++i)
                line[i - half] = optics::times(along, optics::times(across[i], passed[i]));
        }
    }
};

}  // namespace

double PsfTable::products(const HogelGrid& hogels, const Camera& camera, const Pairs& pairs, double half_band,
                          const PixelOffsets& columns, const PixelOffsets& rows) {
    const std::size_t around = reach(hogels, camera, half_band);
    const PsfFilm frame(camera, half_band, around, std::max(columns.width, rows.width));
    const auto size = static_cast<double>(frame.size), taps = static_cast<double>(2 * around + 1);
    const double across = taps * static_cast<double>(columns.places.size()),
                 down = taps * static_cast<double>(rows.places.size());
    // A transform of a line takes about twenty for each number, a wave two.
    constexpr double transform = 20, waves = 2;
    return static_cast<double>(pairs.count) * size * (size * (transform + down) + down * across) +
           waves * (across + down) * size * 2 * static_cast<double>(frame.half);
}

PixelMeans::PixelMeans(const HogelGrid& hogels, const Camera& camera, double half_band, const PixelOffsets& columns,
                       const PixelOffsets& rows) {
    const std::size_t reach = PsfTable::reach(hogels, camera, half_band);
    const PsfFilm frame(camera, half_band, reach, std::max(columns.width, rows.width));
    const Array<float, 2> by_place = pixel_means(columns, reach, frame.size, frame.period, 2 * frame.half);
    across = Array<float, 2>({frame.size, PsfBasis::in_lanes(by_place.extent(0))});
    for (std::size_t place = 0; place < by_place.extent(0); ++place)
        for (std::size_t k = 0; k < frame.size; ++k) across(k, place) = by_place(place, k);
    down = pixel_means(rows, reach, frame.size, frame.period, 2 * frame.half);
}

PsfTable::PsfTable(const HogelGrid& hogels, const Camera& camera, const PsfBasis& basis, const Pairs& pairs,
                   double half_band, double x, double y, const PixelOffsets& columns, const PixelOffsets& rows,
                   const PixelMeans& means)
    : reach_(reach(hogels, camera, half_band)), tails_(pairs.count) {
    const Pupil pupil(hogels, camera, x, y);
    const PsfFilm frame(camera, half_band, reach_, std::max(columns.width, rows.width));
    const double period = frame.period;
    const optics::PupilEdge edge(frame.window, 1);
    const std::size_t half = frame.half, size = frame.size, side = 2 * half + 1;
    const Opening opening(pupil, edge, half, period);
    const double pitch = hogels.plane.pitch_x;
    const Array<Complex, 2> across = lights(basis, half, period, pupil.bend_x(pitch)),
                            down = lights(basis, half, period, pupil.bend_y(pitch));
    const std::size_t across_all = columns.places.size() * taps(), across_padded = means.across.extent(1),
                      down_all = means.down.extent(0);
    const Array<float, 2> passing = opening.passing(across);
    struct Pair {
        std::size_t x, y;
    };
    std::vector<Pair> list;
    for (std::size_t q = 0; q < basis.count(); ++q)
        for (std::size_t r = pairs.of_column[q].begin; r < pairs.of_column[q].end; ++r) list.push_back({q, r});
    const math::Fft2 fft(size, size);
    const double radiance = pupil.radiance();
    // The sum over frequencies in steps of 1/period is an integral over both axes.
    const double scale = 1 / (period * period);
    // Pair by pair, as threads make them.
    Array<float, 3> of_pairs({list.size(), down_all, across_padded});
    work::parallel_for(list.size(), [&](std::size_t pair) {
        const auto [qx, qy] = list[pair];
        Array<Complex, 2> film({size, size});
        opening.fill(&across(qx, 0), &down(qy, 0), static_cast<float>(scale), film);
        float light = 0;
        for (std::size_t row = 0; row < side; ++row) light += std::norm(down(qy, row)) * passing(qx, row);
        fft.backward(film);
        Array<float, 2> spot({size, PsfBasis::in_lanes(size)}), summed_down({down_all, spot.extent(1)});
        for (std::size_t row = 0; row < size; ++row)
            for (std::size_t k = 0; k < size; ++k)
                spot(row, k) = static_cast<float>(radiance) * std::norm(film(row, k));
        multiply(means.down, spot, summed_down);
        const View<float, 2> sums{&of_pairs(pair, 0, 0), {down_all, across_padded}};
        multiply(summed_down, means.across, sums);
        double followed = 0;
        for (const float sum : sums.elements()) followed += sum;
        tails_[pair] = static_cast<float>(radiance * scale * light -
                                          followed / static_cast<double>(columns.places.size() * rows.places.size()));
    });
    weights_ = Array<float, 4>({rows.places.size(), columns.places.size(), taps(), taps() * pairs.padded_count()});
    work::parallel_for(down_all, [&](std::size_t r) {
        constexpr std::size_t together = 16;  // numbers of a cache line
        for (std::size_t first = 0; first < across_all; first += together) {
            const std::size_t count = std::min(together, across_all - first);
            std::array<float*, together> to{};
            for (std::size_t i = 0; i < count; ++i)
                to[i] = &weights_(r / taps(), (first + i) / taps(), r % taps(),
                                  (first + i) % taps() * pairs.padded_count());
            for (std::size_t pair = 0; pair < list.size(); ++pair) {
                const float* from = &of_pairs(pair, r, first);
                for (std::size_t i = 0; i < count; ++i) to[i][pair] = from[i];
            }
        }
    });
}

}  // namespace hogel::camera::speckle_free
