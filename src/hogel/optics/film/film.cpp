// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/film/film.h"

#include <algorithm>
#include <cmath>

#include "hogel/core/parallel.h"
#include "hogel/optics/film/interpolation.h"
#include "hogel/optics/film/lens.h"
#include "hogel/optics/lines.h"

namespace hogel::optics::film {
namespace {

using Complex = std::complex<float>;

const InterpolationTable& interpolation() {
    static const InterpolationTable table;
    return table;
}

std::size_t across(std::ptrdiff_t reach) { return static_cast<std::size_t>(2 * reach + 1); }

}  // namespace

FilmSize::FilmSize(const narrow_band::NarrowBand& band, const FieldGrid& hologram, double pupil, double blur)
    : sines(sine_grid(band, hologram.plane, blur)),
      reach_x(pupil_reach(pupil, band.geometry.eye().z, pupil_step(hologram.wavelength, sines.size_x, sines.step),
                          sines.size_x)),
      reach_y(pupil_reach(pupil, band.geometry.eye().z, pupil_step(hologram.wavelength, sines.size_y, sines.step),
                          sines.size_y)),
      band_rows(band.plane.height) {}

double FilmSize::pupil_bytes() const {
    return static_cast<double>(sizeof(Complex) * across(reach_x) * across(reach_y));
}

double FilmSize::work_bytes() const {
    const std::size_t to_pupil = sines.size_x * (band_rows + across(reach_y)), to_film = sines.size_y * across(reach_x);
    return static_cast<double>(sizeof(Complex) * std::max(to_pupil, to_film)) + pupil_bytes();
}

Film::Film(const narrow_band::NarrowBand& band, const FieldGrid& hologram, double pupil, double blur)
    : band_(band),
      hologram_(hologram),
      size_(band, hologram, pupil, blur),
      along_(size_.sines.size_x),
      down_(size_.sines.size_y) {}

Array<Complex, 2> Film::pupil_wave(View<const Complex, 2> band) const {
    const Grid& plane = band_.plane;
    const InterpolationTable& table = interpolation();
    // Two passes, each along one axis: first to uniform n_x on the band's rows, then down the columns, on which n_x is
    // constant, to uniform n_y. The intermediate result is transposed, so that both passes run along memory.
    Array<Complex, 2> columns({size_.sines.size_x, plane.height});
    const Vec3 eye = band_.geometry.eye();
    // On a row the point of sine n_x lies at x = c_x + n_x/√(1 − n_x²) · √((y − c_y)² + c_z²).
    std::vector<double> slopes(size_.sines.size_x);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const double nx = size_.sines.first_x + static_cast<double>(i) * size_.sines.step;
        slopes[i] = nx / std::sqrt(1 - nx * nx);
    }
    const double middle_x = plane.column(eye.x), middle_y = plane.row(eye.y);
    core::parallel_for(blocks_of(plane.height), [&](std::size_t block) {
        for (std::size_t row = block * lines_together; row < std::min((block + 1) * lines_together, plane.height);
             ++row) {
            const double reach = std::hypot(plane.y(static_cast<double>(row)) - eye.y, eye.z) / plane.pitch_x;
            for (std::size_t i = 0; i < size_.sines.size_x; ++i)
                columns(i, row) = table.at(&band(row, 0), plane.width, middle_x + slopes[i] * reach);
        }
    });
    // Transforms each column and keeps only the frequencies within the pupil.
    Array<Complex, 2> half({across(size_.reach_y), size_.sines.size_x});
    const double reach = eye.z / plane.pitch_y;
    core::parallel_for(blocks_of(size_.sines.size_x), [&](std::size_t block) {
        const std::size_t first = block * lines_together, count = std::min(lines_together, size_.sines.size_x - first);
        Array<Complex, 2> lines({count, stride_of(size_.sines.size_y)});
        for (std::size_t c = 0; c < count; ++c) {
            const std::size_t i = first + c;
            const double nx = size_.sines.first_x + static_cast<double>(i) * size_.sines.step;
            for (std::size_t j = 0; j < size_.sines.size_y; ++j) {
                const double ny = size_.sines.first_y + static_cast<double>(j) * size_.sines.step;
                lines(c, j) =
                    table.at(&columns(i, 0), plane.height, middle_y - reach * ny / std::sqrt(1 - nx * nx - ny * ny));
            }
            down_.forward(&lines(c, 0));
        }
        for (std::ptrdiff_t k = -size_.reach_y; k <= size_.reach_y; ++k)
            for (std::size_t c = 0; c < count; ++c)
                half(k + size_.reach_y, first + c) = lines(c, wrapped(k, size_.sines.size_y));
    });
    Array<Complex, 2> wave({across(size_.reach_y), across(size_.reach_x)});
    core::parallel_for(wave.extent(0), [&](std::size_t row) {
        Array<Complex, 1> line({size_.sines.size_x});
        std::ranges::copy(half[row].elements(), line.data());
        along_.forward(line.data());
        for (std::ptrdiff_t k = -size_.reach_x; k <= size_.reach_x; ++k)
            wave(row, k + size_.reach_x) = line(wrapped(k, size_.sines.size_x));
    });
    return wave;
}

void Film::expose(View<const Complex, 2> pupil_wave, const Camera& camera, View<float, 2> intensity) const {
    const FilmLens lens(size_.sines, hologram_.wavelength, camera);
    // Between nodes the intensities are blended linearly.
    const auto weight = [](std::size_t k, std::size_t size, std::size_t at, std::size_t nodes) {
        const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(size) * static_cast<double>(nodes);
        const double held = std::clamp(place - 0.5, 0.0, static_cast<double>(nodes) - 1);
        return static_cast<float>(std::max(0.0, 1 - std::abs(held - static_cast<double>(at))));
    };
    const std::ptrdiff_t reach_x = std::min(lens.reach_x(), size_.reach_x),
                         reach_y = std::min(lens.reach_y(), size_.reach_y);
    const std::size_t width = across(reach_x);
    Array<Complex, 2> opening({across(reach_y), width}), columns({size_.sines.size_y, width});
    std::vector<float> share(size_.sines.size_x);
    for (std::size_t b = 0; b < lens.nodes_y; ++b)
        for (std::size_t a = 0; a < lens.nodes_x; ++a) {
            core::parallel_for(opening.extent(0), [&](std::size_t y) {
                std::ranges::fill(opening[y].elements(), Complex(0));
                const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) - reach_y;
                lens.row(lens.node_x(a), lens.node_y(b), row, [&](std::ptrdiff_t column, Complex factor) {
                    if (std::abs(column) > reach_x) return;
                    const Complex wave = pupil_wave(row + size_.reach_y, column + size_.reach_x);
                    opening(y, column + reach_x) = {wave.real() * factor.real() - wave.imag() * factor.imag(),
                                                    wave.real() * factor.imag() + wave.imag() * factor.real()};
                });
            });
            // First the few columns of the opening, then each row, whose intensity is added at once.
            core::parallel_for(blocks_of(width), [&](std::size_t block) {
                const std::size_t first = block * lines_together, count = std::min(lines_together, width - first);
                Array<Complex, 2> lines({count, stride_of(size_.sines.size_y)});
                for (std::size_t y = 0; y < opening.extent(0); ++y) {
                    const std::size_t at = wrapped(static_cast<std::ptrdiff_t>(y) - reach_y, size_.sines.size_y);
                    for (std::size_t c = 0; c < count; ++c) lines(c, at) = opening(y, first + c);
                }
                for (std::size_t c = 0; c < count; ++c) down_.backward(&lines(c, 0));
                for (std::size_t j = 0; j < size_.sines.size_y; ++j)
                    for (std::size_t c = 0; c < count; ++c) columns(j, first + c) = lines(c, j);
            });
            for (std::size_t i = 0; i < size_.sines.size_x; ++i)
                share[i] = weight(i, size_.sines.size_x, a, lens.nodes_x);
            core::parallel_for(blocks_of(size_.sines.size_y), [&](std::size_t block) {
                Array<Complex, 1> line({size_.sines.size_x});
                for (std::size_t j = block * lines_together;
                     j < std::min((block + 1) * lines_together, size_.sines.size_y); ++j) {
                    const float down = weight(j, size_.sines.size_y, b, lens.nodes_y);
                    if (down == 0) continue;
                    std::ranges::fill(line.elements(), Complex(0));
                    const auto middle = static_cast<std::size_t>(reach_x);
                    std::copy_n(&columns(j, middle), middle + 1, line.data());
                    std::copy_n(&columns(j, 0), middle, line.data() + size_.sines.size_x - middle);
                    along_.backward(line.data());
                    float* row = &intensity(j, 0);
                    for (std::size_t i = 0; i < size_.sines.size_x; ++i)
                        row[i] += down * share[i] * (line(i).real() * line(i).real() + line(i).imag() * line(i).imag());
                }
            });
        }
}

}  // namespace hogel::optics::film
