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

// Pairs with less than this share of the strongest pair's light in the pupil are omitted.
constexpr double min_share = 1e-4;

// Resolution cells of the support beyond a hogel and its blur, and of the fade-out before samples repeat.
constexpr double cells_followed = 5, cells_fading = 8;

// Returns the width of the blur of a point of the hologram, in hogels.
double blur_width(const HogelGrid& hogels, const Camera& camera) {
    const double lateral = std::hypot(camera.picture.center_x - camera.eye.x, camera.picture.center_y - camera.eye.y);
    const double distance = std::hypot(lateral, camera.eye.z), cosine = camera.eye.z / distance;
    return defocus_blur(camera) * distance / cosine / hogels.plane.pitch_x;
}

// The pupil as seen from one point of the hologram, by frequencies of the demodulated light in cycles per hogel.
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
        // Metres in the pupil per cycle along this line from its middle.
        const double scale = frequency > 0 ? radius / frequency : 1;
        const double inside = (0.5 * camera_.pupil - radius) / scale;
        const double cycles =
            ratio_ == 1 ? 0
                        : (film::path(nx_, ny_, z, dx, dy) - film::path(nx_, ny_, ratio_ * z, dx, dy)) / wavelength_;
        return {inside, cosine_ * cosine_ / square * optics::unit_phasor(cycles)};
    }

    // Returns the radiance per intensity on the film: r² / (cos θ · area of the pupil).
    double radiance() const {
        const double distance = camera_.eye.z / cosine_;
        return distance * distance / (cosine_ * 0.25 * pi * camera_.pupil * camera_.pupil);
    }
    // Return the increase of the demodulation's frequency over a hogel, in cycles, across and down.
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

// Returns Σ_j e^{2πi(y−κ)(j−c)/n + πi bend ((j−c)/n)²}/n: dirichlet() for a hogel with a chirp of the demodulation.
std::complex<double> bent_dirichlet(double y, std::size_t samples, double bend) {
    const auto n = static_cast<double>(samples);
    if (std::abs(bend) < 1e-3) return dirichlet(y, samples) / n;
    std::complex<double> sum = 0;
    for (std::size_t j = 0; j < samples; ++j) {
        const double position = (static_cast<double>(j) - 0.5 * (n - 1)) / n;
        sum += optics::unit_phasor(y * position + 0.5 * bend * position * position);
    }
    return sum / n;
}

// Returns the light of each node wave: [q][κ = −half … half, in steps of 1/period].
Array<Complex, 2> wave_amplitudes(const PsfBasis& basis, std::size_t half, double period, double bend) {
    Array<Complex, 2> values({basis.count(), 2 * half + 1});
    for (std::size_t q = 0; q < basis.count(); ++q)
        for (std::size_t i = 0; i < 2 * half + 1; ++i) {
            const double kappa = (static_cast<double>(i) - static_cast<double>(half)) / period;
            values(q, i) = Complex(bent_dirichlet(basis.node(q) - kappa, basis.samples(), bend));
        }
    return values;
}

// Returns [entry · tap][sample]: the mean over a pixel, at each offset from a hogel, of an intensity with these samples
// over a period; sample 0 is at the hogel. Exact for an intensity with frequencies up to `highest` / period. With r =
// e^{2πi/samples}, sample k of a wave of frequency f is r^{fk}.
Array<float, 2> pixel_means(const PixelOffsets& offsets, std::size_t support, std::size_t samples, double period,
                            std::size_t highest) {
    const std::size_t taps = 2 * support + 1;
    Array<float, 2> means({offsets.entries.size() * taps, samples});
    std::vector<std::complex<double>> roots(samples);
    for (std::size_t i = 0; i < samples; ++i)
        roots[i] = optics::unit_phasor(static_cast<double>(i) / static_cast<double>(samples));
    work::parallel_for(means.extent(0), [&](std::size_t row) {
        const double hogel = static_cast<double>(row % taps) - static_cast<double>(support);
        const auto [offset, width] = offsets.entries[row / taps];
        const double from = offset - hogel;
        std::vector<std::complex<double>> waves(highest);  // averaged over the pixel
        for (std::size_t f = 1; f <= highest; ++f) {
            const double frequency = static_cast<double>(f) / period, angle = pi * frequency * width;
            waves[f - 1] = 2 * (angle > 0 ? std::sin(angle) / angle : 1) * optics::unit_phasor(frequency * from);
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

double half_band(const HogelGrid& hogels, Vec3 viewpoint, double pupil) {
    const Grid& plane = hogels.plane;
    const double x = std::clamp(viewpoint.x, plane.center_x - plane.size_x() / 2, plane.center_x + plane.size_x() / 2);
    const double y = std::clamp(viewpoint.y, plane.center_y - plane.size_y() / 2, plane.center_y + plane.size_y() / 2);
    const double path = hogels.wavelength * ViewGeometry(viewpoint, hogels.wavelength).distance(x, y);
    return 0.5 * pupil * plane.pitch_x / path;
}

NodePairs::NodePairs(const PsfNodes& basis, double half_band) : ranges(basis.count()) {
    constexpr std::size_t points = 32;
    const std::size_t nodes = basis.count();
    Array<double, 2> squares({nodes, points}), light({nodes, nodes});
    const auto position = [&](std::size_t i) {
        return half_band * (2 * (static_cast<double>(i) + 0.5) / double{points} - 1);
    };
    for (std::size_t q = 0; q < nodes; ++q)
        for (std::size_t i = 0; i < points; ++i) {
            const double value = dirichlet(basis.node(q) - position(i), basis.samples());
            squares(q, i) = value * value;
        }
    double strongest = 0;
    for (std::size_t x = 0; x < nodes; ++x) {
        std::array<double, points> across{};  // summed over the part of the disc at each position down
        for (std::size_t j = 0; j < points; ++j)
            for (std::size_t i = 0; i < points; ++i)
                if (std::hypot(position(i), position(j)) < half_band) across[j] += squares(x, i);
        for (std::size_t y = 0; y < nodes; ++y) {
            for (std::size_t j = 0; j < points; ++j) light(x, y) += across[j] * squares(y, j);
            strongest = std::max(strongest, light(x, y));
        }
    }
    for (std::size_t x = 0; x < nodes; ++x) {
        Range& range = ranges[x];
        while (range.begin < nodes && light(x, range.begin) < min_share * strongest) ++range.begin;
        range.end = nodes;
        while (range.end > range.begin && light(x, range.end - 1) < min_share * strongest) --range.end;
        count += range.end - range.begin;
    }
}

std::size_t max_offsets(const NodePairs& pairs, std::size_t support) {
    constexpr double max_bytes = 64e6;
    const auto taps = static_cast<double>(2 * support + 1);
    const double bytes = taps * taps * static_cast<double>(pairs.padded_count() * sizeof(float));
    return static_cast<std::size_t>(std::clamp(std::sqrt(max_bytes / bytes), 4.0, 32.0));
}

PixelOffsets pixel_offsets(std::size_t pixels, double first, double step, std::size_t hogels, std::size_t border,
                           std::size_t max_offsets) {
    PixelOffsets offsets;
    const double begin = -0.5 - static_cast<double>(border), end = static_cast<double>(hogels + border) - 0.5;
    for (const bool rounded : {false, true}) {
        offsets = {{}, {}, {}, {}, step, border};
        for (std::size_t i = 0; i < pixels; ++i) {
            const double u = first + static_cast<double>(i) * step;
            const double low = std::clamp(u - 0.5 * step, begin, end), high = std::clamp(u + 0.5 * step, begin, end);
            const double middle = 0.5 * (low + high), base = std::floor(middle + 0.5);
            PixelOffsets::Entry entry{middle - base, high - low};
            const auto steps = static_cast<double>(max_offsets);
            if (rounded) entry.offset = std::round(entry.offset * steps) / steps;
            const auto found = std::ranges::find_if(offsets.entries, [&](const PixelOffsets::Entry& other) {
                return std::abs(other.offset - entry.offset) < 1e-5 && std::abs(other.width - entry.width) < 1e-5;
            });
            offsets.entry.push_back(static_cast<std::size_t>(found - offsets.entries.begin()));
            if (found == offsets.entries.end()) offsets.entries.push_back(entry);
            offsets.base.push_back(static_cast<std::ptrdiff_t>(base));
            offsets.visible.push_back(static_cast<float>(entry.width / step));
        }
        // Three more entries are for pixels across and beyond the edges.
        if (offsets.entries.size() <= max_offsets + 3) break;
    }
    return offsets;
}

std::size_t PsfTable::support(const HogelGrid& hogels, const Camera& camera, double half_band) {
    const double pixel = std::max(camera.picture.pitch_x, camera.picture.pitch_y) / hogels.plane.pitch_x;
    const double cell = 0.5 / half_band;
    return static_cast<std::size_t>(
        std::ceil(0.5 + 0.5 * blur_width(hogels, camera) + cells_followed * cell + 0.5 * pixel));
}

namespace {

// Film of a PSF: its period in hogels, and the number of the pupil's samples.
struct PsfFilm {
    optics::SpreadWindow window{0, 0, 0, 1};
    double period = 0;
    std::size_t half = 0, size = 0;

    PsfFilm(const Camera& camera, double half_band, std::size_t support, double pixel) {
        // Up to `support` the PSF is exact; it ends before the next period's support begins.
        window.flat = static_cast<double>(support) + 0.5;
        window.stop = window.flat + pixel + cells_fading * 0.5 / half_band;
        period = window.flat + window.stop;
        const double radius = film::frequency_radius(2 * half_band, 2 * half_band * camera.eye.z / camera.pupil);
        half = static_cast<std::size_t>(std::ceil((radius + optics::PupilEdge(window, 1).reach()) * period));
        size = math::good_fft_size(4 * half + 2);
    }
};

// Samples of the pupil at κ = −half … half, in steps of 1/period, [down][across].
struct PupilSamples {
    Array<Complex, 2> wave;
    Array<float, 2> energy;  // energy of a sample; on the rim, of the part of its cell in the disc

    PupilSamples(const Pupil& pupil, const optics::PupilEdge& edge, std::size_t half, double period)
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

    // Returns [wave][row]: the light of each wave across that a row of the pupil transmits.
    Array<float, 2> transmitted(View<const Complex, 2> across) const {
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

    // Fills `film` with the light of two waves, across and down, in the pupil, in the order of a transform.
    void fill(const Complex* across, const Complex* down, float scale, View<Complex, 2> film) const {
        const std::size_t side = wave.extent(0), half = side / 2, size = film.extent(0);
        for (std::size_t row = 0; row < side; ++row) {
            const Complex row_factor = scale * down[row], *transmission_row = &wave(row, 0);
            Complex* const line = &film((row + size - half) % size, 0);
            for (std::size_t i = 0; i < half; ++i)
                line[size - half + i] = optics::times(row_factor, optics::times(across[i], transmission_row[i]));
            for (std::size_t i = half; i < side; ++i)
                line[i - half] = optics::times(row_factor, optics::times(across[i], transmission_row[i]));
        }
    }
};

}  // namespace

double PsfTable::products(const HogelGrid& hogels, const Camera& camera, const NodePairs& pairs, double half_band,
                          const PixelOffsets& columns, const PixelOffsets& rows) {
    const std::size_t support_hogels = support(hogels, camera, half_band);
    const PsfFilm film_size(camera, half_band, support_hogels, std::max(columns.width, rows.width));
    const auto size = static_cast<double>(film_size.size), taps = static_cast<double>(2 * support_hogels + 1);
    const double across = taps * static_cast<double>(columns.entries.size()),
                 down = taps * static_cast<double>(rows.entries.size());
    // Products per number: about twenty for a transform of a line, two for a wave.
    constexpr double transform = 20, waves = 2;
    return static_cast<double>(pairs.count) * size * (size * (transform + down) + down * across) +
           waves * (across + down) * size * 2 * static_cast<double>(film_size.half);
}

PixelMeans::PixelMeans(const HogelGrid& hogels, const Camera& camera, double half_band, const PixelOffsets& columns,
                       const PixelOffsets& rows) {
    const std::size_t support = PsfTable::support(hogels, camera, half_band);
    const PsfFilm film_size(camera, half_band, support, std::max(columns.width, rows.width));
    const Array<float, 2> by_entry =
        pixel_means(columns, support, film_size.size, film_size.period, 2 * film_size.half);
    across = Array<float, 2>({film_size.size, PsfBasis::padded_to_lanes(by_entry.extent(0))});
    for (std::size_t entry = 0; entry < by_entry.extent(0); ++entry)
        for (std::size_t k = 0; k < film_size.size; ++k) across(k, entry) = by_entry(entry, k);
    down = pixel_means(rows, support, film_size.size, film_size.period, 2 * film_size.half);
}

PsfTable::PsfTable(const HogelGrid& hogels, const Camera& camera, const PsfBasis& basis, const NodePairs& pairs,
                   double half_band, double x, double y, const PixelOffsets& columns, const PixelOffsets& rows,
                   const PixelMeans& means)
    : support_(support(hogels, camera, half_band)), tails_(pairs.count) {
    const Pupil pupil(hogels, camera, x, y);
    const PsfFilm film_size(camera, half_band, support_, std::max(columns.width, rows.width));
    const double period = film_size.period;
    const optics::PupilEdge edge(film_size.window, 1);
    const std::size_t half = film_size.half, size = film_size.size, side = 2 * half + 1;
    const PupilSamples pupil_samples(pupil, edge, half, period);
    const double pitch = hogels.plane.pitch_x;
    const Array<Complex, 2> across = wave_amplitudes(basis, half, period, pupil.bend_x(pitch)),
                            down = wave_amplitudes(basis, half, period, pupil.bend_y(pitch));
    const std::size_t all_across = columns.entries.size() * taps(), across_padded = means.across.extent(1),
                      all_down = means.down.extent(0);
    const Array<float, 2> transmitted = pupil_samples.transmitted(across);
    struct Pair {
        std::size_t x, y;
    };
    std::vector<Pair> list;
    for (std::size_t q = 0; q < basis.count(); ++q)
        for (std::size_t r = pairs.ranges[q].begin; r < pairs.ranges[q].end; ++r) list.push_back({q, r});
    const math::Fft2 fft(size, size);
    const double radiance = pupil.radiance();
    // The sum over frequencies in steps of 1/period is an integral over both axes.
    const double scale = 1 / (period * period);
    // Ordered by pair, because a thread computes a pair.
    Array<float, 3> pair_sums({list.size(), all_down, across_padded});
    work::parallel_for(list.size(), [&](std::size_t pair) {
        const auto [qx, qy] = list[pair];
        Array<Complex, 2> film({size, size});
        pupil_samples.fill(&across(qx, 0), &down(qy, 0), static_cast<float>(scale), film);
        float light = 0;
        for (std::size_t row = 0; row < side; ++row) light += std::norm(down(qy, row)) * transmitted(qx, row);
        fft.backward(film);
        Array<float, 2> intensity({size, PsfBasis::padded_to_lanes(size)}), sums_down({all_down, intensity.extent(1)});
        for (std::size_t row = 0; row < size; ++row)
            for (std::size_t k = 0; k < size; ++k)
                intensity(row, k) = static_cast<float>(radiance) * std::norm(film(row, k));
        multiply(means.down, intensity, sums_down);
        const View<float, 2> sums{&pair_sums(pair, 0, 0), {all_down, across_padded}};
        multiply(sums_down, means.across, sums);
        double followed = 0;
        for (const float sum : sums.elements()) followed += sum;
        tails_[pair] = static_cast<float>(radiance * scale * light -
                                          followed / static_cast<double>(columns.entries.size() * rows.entries.size()));
    });
    weights_ = Array<float, 4>({rows.entries.size(), columns.entries.size(), taps(), taps() * pairs.padded_count()});
    work::parallel_for(all_down, [&](std::size_t r) {
        constexpr std::size_t entries_per_pass = 16;  // numbers of a cache line
        for (std::size_t first = 0; first < all_across; first += entries_per_pass) {
            const std::size_t count = std::min(entries_per_pass, all_across - first);
            std::array<float*, entries_per_pass> destinations{};
            for (std::size_t i = 0; i < count; ++i)
                destinations[i] = &weights_(r / taps(), (first + i) / taps(), r % taps(),
                                            (first + i) % taps() * pairs.padded_count());
            for (std::size_t pair = 0; pair < list.size(); ++pair) {
                const float* source = &pair_sums(pair, r, first);
                for (std::size_t i = 0; i < count; ++i) destinations[i][pair] = source[i];
            }
        }
    });
}

}  // namespace hogel::camera::speckle_free
