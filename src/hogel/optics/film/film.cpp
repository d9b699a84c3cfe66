// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/film/film.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hogel/core/parallel.h"
#include "hogel/optics/film/interpolation.h"
#include "hogel/optics/film/lens.h"
#include "hogel/optics/film/resample.h"
#include "hogel/optics/lines.h"
#include "hogel/optics/phase_walk.h"

namespace hogel::optics::film {
namespace {

using Complex = std::complex<float>;

const InterpolationTable& interpolation() {
    static const InterpolationTable table;
    return table;
}

std::size_t across(std::ptrdiff_t reach) { return static_cast<std::size_t>(2 * reach + 1); }

FilmAxis film_axis(double first, double period, const SineGrid::Range& seen, std::size_t frequencies, double cells) {
    FilmAxis axis;
    const double wanted = std::ceil(samples_a_cell * period * cells);
    axis.size = math::good_fft_size(std::max(frequencies, static_cast<std::size_t>(wanted)));
    axis.step = period / static_cast<double>(axis.size);
    const double last = static_cast<double>(axis.size);
    const double begin = std::clamp(std::floor((seen.low - first) / axis.step) - TwelvePoint::taps, 0.0, last),
                 end = std::clamp(std::ceil((seen.high - first) / axis.step) + TwelvePoint::taps, 0.0, last);
    axis.first = static_cast<std::size_t>(begin);
    axis.count = static_cast<std::size_t>(end) - axis.first;
    axis.low = first + begin * axis.step;
    return axis;
}

// The rows of a band that are not dark, [begin, end), widened by what the kernel of the resampling reaches.
struct LitRows {
    double begin, end;
};
std::vector<LitRows> lit_rows_of(const std::vector<char>& is_lit) {
    std::vector<LitRows> all;
    for (std::size_t row = 0; row < is_lit.size(); ++row) {
        if (!is_lit[row]) continue;
        constexpr double reach = InterpolationTable::taps;
        const double begin = static_cast<double>(row) - reach, end = static_cast<double>(row) + reach;
        if (!all.empty() && begin <= all.back().end)
            all.back().end = end;
        else
            all.push_back({begin, end});
    }
    return all;
}

}  // namespace

FilmSize::FilmSize(const narrow_band::BandGrid& band, const FieldGrid& hologram, double pupil, double blur)
    : sines(sine_grid(band, hologram.plane, pupil, blur)), band_rows(band.plane.height) {
    const double wavelength = hologram.wavelength;
    const PupilEdge edge(spread_window(sines, wavelength, pupil, blur), wavelength);
    const double radius = frequency_radius(pupil, band.geometry.eye().z) + edge.reach();
    const auto reach = [&](double period, std::size_t size) {
        return std::min(static_cast<std::ptrdiff_t>(radius / pupil_step(wavelength, period)) + 1,
                        static_cast<std::ptrdiff_t>(size - 1) / 2);
    };
    reach_x = reach(sines.period_x(), sines.size_x);
    reach_y = reach(sines.period_y(), sines.size_y);
    x = film_axis(sines.first_x, sines.period_x(), sines.x, across(reach_x), pupil / wavelength);
    y = film_axis(sines.first_y, sines.period_y(), sines.y, across(reach_y), pupil / wavelength);
    // The kernel of the resampling reaches a few samples beyond the band.
    Grid around = band.plane;
    around.width += 2 * InterpolationTable::taps;
    around.height += 2 * InterpolationTable::taps;
    const SineRanges lit = sines_of(band.geometry, around);
    const auto index = [&](double sine, double first, std::size_t size) {
        return static_cast<std::size_t>(std::clamp(std::ceil((sine - first) / sines.step), 0.0, double(size)));
    };
    lit_left = index(lit.x.low, sines.first_x, sines.size_x);
    lit_right = index(lit.x.high, sines.first_x, sines.size_x);
    lit_low = index(lit.y.low, sines.first_y, sines.size_y);
    lit_high = index(lit.y.high, sines.first_y, sines.size_y);
}

double FilmSize::pupil_bytes() const {
    return static_cast<double>(sizeof(Complex) * across(reach_x) * across(reach_y));
}

double FilmSize::work_bytes() const {
    const std::size_t to_pupil = (lit_right - lit_left) * band_rows + sines.size_x * across(reach_y),
                      to_film = y.count * across(reach_x);
    return static_cast<double>(sizeof(Complex) * std::max(to_pupil, to_film)) + pupil_bytes();
}

double FilmSize::intensity_bytes() const { return static_cast<double>(sizeof(float) * x.count * y.count); }

Film::Film(const narrow_band::BandGrid& band, const FieldGrid& hologram, double pupil, double blur)
    : band_(band),
      hologram_(hologram),
      size_(band, hologram, pupil, blur),
      along_(size_.sines.size_x),
      down_(size_.sines.size_y),
      film_along_(size_.x.size),
      film_down_(size_.y.size) {}

Array<Complex, 2> Film::pupil_wave(View<const Complex, 2> band) const {
    const Grid& plane = band_.plane;
    const SineGrid& sines = size_.sines;
    const InterpolationTable& table = interpolation();
    // Two passes, each along one axis: first to uniform n_x on the band's rows, then down the columns, on which n_x is
    // constant, to uniform n_y. The intermediate result is transposed, so that both passes run along memory.
    const std::size_t lit_columns = size_.lit_right - size_.lit_left, lit_rows = size_.lit_high - size_.lit_low;
    Array<Complex, 2> columns({lit_columns, plane.height});
    std::vector<char> is_lit(plane.height);
    const Vec3 eye = band_.geometry.eye();
    const double left = sines.first_x + static_cast<double>(size_.lit_left) * sines.step,
                 low = sines.first_y + static_cast<double>(size_.lit_low) * sines.step;
    core::parallel_for(blocks_of(plane.height), [&](std::size_t block) {
        const std::size_t first = block * lines_together, count = std::min(lines_together, plane.height - first);
        // Most rows are dark where the lines of a hologram are photographed apart.
        bool all_dark = true;
        for (std::size_t r = first; r < first + count; ++r) {
            is_lit[r] = !std::ranges::all_of(band[r].elements(), [](Complex value) { return value == Complex(0); });
            all_dark = all_dark && !is_lit[r];
        }
        if (all_dark) return;
        Array<Complex, 2> lines({count, stride_of(lit_columns)});
        for (std::size_t r = 0; r < count; ++r) {
            // On a row the point of sine n_x lies at x = c_x + n_x/√(1 − n_x²) · √((y − c_y)² + c_z²).
            const double reach = std::hypot(plane.y(static_cast<double>(first + r)) - eye.y, eye.z);
            resample_tangents({&band(first + r, 0), plane.width},
                              {left, sines.step, 1, reach / plane.pitch_x, plane.column(eye.x)}, table,
                              {&lines(r, 0), lit_columns});
        }
        for (std::size_t i = 0; i < lit_columns; ++i)
            for (std::size_t r = 0; r < count; ++r) columns(i, first + r) = lines(r, i);
    });
    const std::vector<LitRows> lit = lit_rows_of(is_lit);
    // Transforms each column and keeps only the frequencies within the pupil.
    Array<Complex, 2> half({across(size_.reach_y), sines.size_x});
    core::parallel_for(blocks_of(lit_columns), [&](std::size_t block) {
        const std::size_t first = block * lines_together, count = std::min(lines_together, lit_columns - first);
        Array<Complex, 2> lines({count, stride_of(sines.size_y)});
        for (std::size_t c = 0; c < count; ++c) {
            const double nx = left + static_cast<double>(first + c) * sines.step;
            const double row_of_eye = plane.row(eye.y), rows_per_tangent = -eye.z / plane.pitch_y;
            for (const LitRows& rows : lit) {
                // The sine of the row at the tangent v is v √(1 − n_x²)/√(1 + v²).
                const auto place = [&](double row) {
                    const double tangent = (row - row_of_eye) / rows_per_tangent;
                    const double sine = tangent * std::sqrt(1 - nx * nx) / std::hypot(1.0, tangent);
                    return std::clamp((sine - low) / sines.step, 0.0, static_cast<double>(lit_rows));
                };
                const bool all = rows.begin < 0 && rows.end > static_cast<double>(plane.height);
                const std::size_t from = all ? 0 : static_cast<std::size_t>(place(rows.end)),
                                  to = all ? lit_rows : static_cast<std::size_t>(std::ceil(place(rows.begin)));
                resample_tangents({&columns(first + c, 0), plane.height},
                                  {low + static_cast<double>(from) * sines.step, sines.step, 1 - nx * nx,
                                   rows_per_tangent, row_of_eye},
                                  table, {&lines(c, size_.lit_low + from), to - from});
            }
            down_.forward(&lines(c, 0));
        }
        for (std::ptrdiff_t k = -size_.reach_y; k <= size_.reach_y; ++k)
            for (std::size_t c = 0; c < count; ++c)
                half(k + size_.reach_y, size_.lit_left + first + c) = lines(c, wrapped(k, sines.size_y));
    });
    Array<Complex, 2> wave({across(size_.reach_y), across(size_.reach_x)});
    core::parallel_for(wave.extent(0), [&](std::size_t row) {
        Array<Complex, 1> line({sines.size_x});
        std::ranges::copy(half[row].elements(), line.data());
        along_.forward(line.data());
        for (std::ptrdiff_t k = -size_.reach_x; k <= size_.reach_x; ++k)
            wave(row, k + size_.reach_x) = line(wrapped(k, sines.size_x));
    });
    return wave;
}

void Film::expose(std::span<const Array<Complex, 2>> pupil_waves, const Camera& camera,
                  View<float, 2> intensity) const {
    const FilmLens lens(size_.sines, hologram_.wavelength, camera);
    // Between nodes the intensities are blended linearly.
    const auto shares = [](const FilmAxis& axis, const SineGrid::Range& sines, std::size_t at, std::size_t nodes) {
        std::vector<float> share(axis.count);
        for (std::size_t k = 0; k < axis.count; ++k) {
            const double sine = axis.low + static_cast<double>(k) * axis.step;
            const double place = (sine - sines.low) / sines.span() * static_cast<double>(nodes);
            const double held = std::clamp(place - 0.5, 0.0, static_cast<double>(nodes) - 1);
            share[k] = static_cast<float>(std::max(0.0, 1 - std::abs(held - static_cast<double>(at))));
        }
        return share;
    };
    const std::ptrdiff_t reach_x = std::min(lens.reach_x(), size_.reach_x),
                         reach_y = std::min(lens.reach_y(), size_.reach_y);
    Array<Complex, 2> factors({across(reach_y), across(reach_x)});
    for (std::size_t b = 0; b < lens.nodes_y; ++b)
        for (std::size_t a = 0; a < lens.nodes_x; ++a) {
            core::parallel_for(factors.extent(0), [&](std::size_t y) {
                std::ranges::fill(factors[y].elements(), Complex(0));
                lens.row(lens.node_x(a), lens.node_y(b), static_cast<std::ptrdiff_t>(y) - reach_y,
                         [&](std::ptrdiff_t column, Complex factor) {
                             if (std::abs(column) <= reach_x) factors(y, column + reach_x) = factor;
                         });
            });
            const std::vector<float> share_x = shares(size_.x, size_.sines.x, a, lens.nodes_x),
                                     share_y = shares(size_.y, size_.sines.y, b, lens.nodes_y);
            for (const Array<Complex, 2>& wave : pupil_waves) expose_node(wave, factors, share_x, share_y, intensity);
        }
}

void Film::expose_node(View<const Complex, 2> pupil_wave, View<const Complex, 2> lens, std::span<const float> share_x,
                       std::span<const float> share_y, View<float, 2> intensity) const {
    const std::size_t width = lens.extent(1), height = lens.extent(0), middle = width / 2;
    const std::size_t left = static_cast<std::size_t>(size_.reach_x) - middle,
                      top = static_cast<std::size_t>(size_.reach_y) - height / 2;
    Array<Complex, 2> columns({size_.y.count, width});
    // First the few columns of the opening, then each row, whose intensity is added at once.
    core::parallel_for(blocks_of(width), [&](std::size_t block) {
        const std::size_t first = block * lines_together, count = std::min(lines_together, width - first);
        Array<Complex, 2> lines({count, stride_of(size_.y.size)});
        for (std::size_t y = 0; y < height; ++y) {
            const std::size_t at =
                wrapped(static_cast<std::ptrdiff_t>(y) - static_cast<std::ptrdiff_t>(height / 2), size_.y.size);
            const Complex *wave = &pupil_wave(top + y, left + first), *factor = &lens(y, first);
            for (std::size_t c = 0; c < count; ++c) lines(c, at) = times(wave[c], factor[c]);
        }
        for (std::size_t c = 0; c < count; ++c) film_down_.backward(&lines(c, 0));
        for (std::size_t j = 0; j < size_.y.count; ++j)
            for (std::size_t c = 0; c < count; ++c) columns(j, first + c) = lines(c, size_.y.first + j);
    });
    core::parallel_for(blocks_of(size_.y.count), [&](std::size_t block) {
        Array<Complex, 1> line({size_.x.size});
        for (std::size_t j = block * lines_together; j < std::min((block + 1) * lines_together, size_.y.count); ++j) {
            if (share_y[j] == 0) continue;
            std::ranges::fill(line.elements(), Complex(0));
            std::copy_n(&columns(j, middle), middle + 1, line.data());
            std::copy_n(&columns(j, 0), middle, line.data() + size_.x.size - middle);
            film_along_.backward(line.data());
            float* row = &intensity(j, 0);
            const Complex* seen = line.data() + size_.x.first;
            for (std::size_t i = 0; i < size_.x.count; ++i)
                row[i] += share_y[j] * share_x[i] * (seen[i].real() * seen[i].real() + seen[i].imag() * seen[i].imag());
        }
    });
}

}  // namespace hogel::optics::film
