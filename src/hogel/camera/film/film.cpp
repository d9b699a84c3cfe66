// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/film/film.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hogel/camera/film/interpolation.h"
#include "hogel/camera/film/lanes.h"
#include "hogel/camera/film/lens.h"
#include "hogel/camera/film/resample.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/math/fft.h"
#include "hogel/optics/lines.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::film {
namespace {

using Complex = std::complex<float>;

const InterpolationTable& interpolation() {
    static const InterpolationTable table;
    return table;
}

std::size_t across(std::ptrdiff_t reach) { return static_cast<std::size_t>(2 * reach + 1); }

constexpr std::size_t padded(std::size_t lines) { return optics::blocks_of(lines) * optics::block_lines; }

// Floats of sixteen complex numbers side by side, and of a block of sixteen rows of so many.
constexpr std::size_t both = math::SplitFft::row;
static_assert(both == 2 * optics::block_lines && optics::block_lines == PackedBand::side);

FilmAxis film_axis(double first, double period, const SineGrid::Range& seen, std::size_t frequencies, double samples) {
    FilmAxis axis;
    const double wanted = std::ceil(samples * period);
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
struct ActiveRows {
    double begin, end;
};
std::vector<ActiveRows> active_rows_of(const std::vector<char>& is_active) {
    std::vector<ActiveRows> all;
    for (std::size_t row = 0; row < is_active.size(); ++row) {
        if (!is_active[row]) continue;
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

FilmSize::FilmSize(const narrow_band::BandGrid& band, const FieldGrid& hologram, const Rectangle& shown, double pupil,
                   double blur, double samples)
    : sines(sine_grid(band, hologram.plane, shown, pupil, blur)), band_rows(band.plane.height) {
    const double wavelength = hologram.wavelength;
    const optics::PupilEdge edge(spread_window(sines, wavelength, pupil, blur), wavelength);
    const double radius = frequency_radius(pupil, band.geometry.eye().z) + edge.reach();
    const auto reach = [&](double period, std::size_t size) {
        return std::min(static_cast<std::ptrdiff_t>(radius / pupil_step(wavelength, period)) + 1,
                        static_cast<std::ptrdiff_t>(size - 1) / 2);
    };
    reach_x = reach(sines.period_x(), sines.size_x);
    reach_y = reach(sines.period_y(), sines.size_y);
    x = film_axis(sines.first_x, sines.period_x(), sines.shown_x, across(reach_x), samples * pupil / wavelength);
    y = film_axis(sines.first_y, sines.period_y(), sines.shown_y, across(reach_y), samples * pupil / wavelength);
    // The kernel of the resampling reaches a few samples beyond the band.
    Grid around = band.plane;
    around.width += 2 * InterpolationTable::taps;
    around.height += 2 * InterpolationTable::taps;
    const SineRanges active = sines_of(band.geometry, around);
    const auto index = [&](double sine, double first, std::size_t size) {
        return static_cast<std::size_t>(std::clamp(std::ceil((sine - first) / sines.step), 0.0, double(size)));
    };
    active_left = index(active.x.low, sines.first_x, sines.size_x);
    active_right = index(active.x.high, sines.first_x, sines.size_x);
    active_low = index(active.y.low, sines.first_y, sines.size_y);
    active_high = index(active.y.high, sines.first_y, sines.size_y);
}

double FilmSize::pupil_bytes() const {
    return static_cast<double>(sizeof(math::PackedComplex) * across(reach_x) * padded(across(reach_y)));
}

double FilmSize::work_bytes() const {
    // Both are kept for the next look, and the lens.
    const double lens_bytes = 2 * pupil_bytes();
    const std::size_t to_pupil = (active_right - active_left) * (band_rows + padded(across(reach_y))),
                      to_film = padded(x.count) * padded(across(reach_y));
    return static_cast<double>(sizeof(Complex) * (to_pupil + to_film)) + lens_bytes;
}

double FilmSize::intensity_bytes() const { return static_cast<double>(sizeof(float) * padded(x.count) * y.count); }

Film::Film(const narrow_band::BandGrid& band, const FieldGrid& hologram, const Rectangle& shown, double pupil,
           double blur, double samples)
    : band_(band),
      hologram_(hologram),
      size_(band, hologram, shown, pupil, blur, samples),
      along_(size_.sines.size_x),
      down_(size_.sines.size_y),
      film_along_(size_.x.size),
      film_down_(size_.y.size),
      scratch_(std::make_unique<core::ObjectPool<Scratch>>()) {
    for (std::ptrdiff_t k = -size_.reach_x; k <= size_.reach_x; ++k)
        frequencies_x_.push_back(along_.place(optics::wrapped(k, along_.size())));
    for (std::ptrdiff_t k = -size_.reach_y; k <= size_.reach_y; ++k)
        frequencies_y_.push_back(down_.place(optics::wrapped(k, down_.size())));
    for (std::size_t i = 0; i < size_.x.count; ++i) film_x_.push_back(film_along_.place(size_.x.first + i));
    for (std::size_t j = 0; j < size_.y.count; ++j) film_y_.push_back(film_down_.place(size_.y.first + j));
}

PupilWave Film::pupil_wave(const PackedBand& band) const {
    // Two passes, each along one axis: first to uniform n_x on the band's rows, then down the columns, on which n_x is
    // constant, to uniform n_y. The intermediate result is transposed, so that both passes run along memory.
    auto scratch = scratch_->take();
    std::vector<char> is_active(band.height());
    resample_rows(band, is_active, *scratch);
    transform_columns(is_active, *scratch);
    const std::size_t active = size_.active_right - size_.active_left, width = across(size_.reach_x);
    PupilWave wave({optics::blocks_of(across(size_.reach_y)), width * optics::block_lines});
    work::parallel_for(wave.extent(0), [&](std::size_t block) {
        const core::ThreadBuffer<float> lines(along_.size() * both);
        std::fill_n(lines.data(), size_.active_left * both, 0.0f);
        std::copy_n(&scratch->half(block, 0), active * both, &lines[size_.active_left * both]);
        std::fill_n(lines.data() + size_.active_right * both, (along_.size() - size_.active_right) * both, 0.0f);
        along_.transform(lines.data());
        pack_rows(lines.data(), frequencies_x_, &wave(block, 0));
    });
    return wave;
}

void Film::resample_rows(const PackedBand& band, std::vector<char>& is_active, Scratch& scratch) const {
    const Grid& plane = band_.plane;
    const SineGrid& sines = size_.sines;
    const std::size_t active_columns = size_.active_right - size_.active_left,
                      row_blocks = optics::blocks_of(plane.height);
    if (scratch.columns.size() == 0)
        scratch.columns = Array<float, 3>({optics::blocks_of(active_columns), row_blocks, optics::block_lines * both});
    const Vec3 eye = band_.geometry.eye();
    work::parallel_for(row_blocks, [&](std::size_t block) {
        const std::size_t first = block * optics::block_lines,
                          count = std::min(optics::block_lines, plane.height - first);
        // Most rows are dark where the lines of a hologram are photographed apart.
        bool all_dark = true;
        for (std::size_t r = first; r < first + count; ++r) {
            is_active[r] = band.is_active(r);
            all_dark = all_dark && !is_active[r];
        }
        if (all_dark) {
            for (std::size_t i = 0; i < scratch.columns.extent(0); ++i)
                std::ranges::fill(scratch.columns[i][block].elements(), 0.0f);
            return;
        }
        const core::ThreadBuffer<float> lines(padded(plane.width) * both);
        side_by_side(band.at(first, 0), optics::blocks_of(plane.width), lines.data());
        // On a row the point of sine n_x lies at x = c_x + n_x/√(1 − n_x²) · √((y − c_y)² + c_z²).
        TangentPositions places{0, sines.step, plane.column(eye.x), {}, {}};
        places.squares.fill(1);
        for (std::size_t r = 0; r < optics::block_lines; ++r) {
            const auto row = static_cast<double>(first + std::min(r, count - 1));
            places.scales[r] = std::hypot(plane.y(row) - eye.y, eye.z) / plane.pitch_x;
        }
        for (std::size_t i = 0; i < active_columns; i += optics::block_lines) {
            places.first = sines.first_x + static_cast<double>(size_.active_left + i) * sines.step;
            resample_lines(lines.data(), plane.width, places, interpolation(),
                           std::min(optics::block_lines, active_columns - i),
                           &scratch.columns(i / optics::block_lines, block, 0));
        }
    });
}

void Film::transform_columns(const std::vector<char>& is_active, Scratch& scratch) const {
    const Grid& plane = band_.plane;
    const SineGrid& sines = size_.sines;
    const std::size_t active_columns = size_.active_right - size_.active_left,
                      active_rows = size_.active_high - size_.active_low;
    const Vec3 eye = band_.geometry.eye();
    const double low = sines.first_y + static_cast<double>(size_.active_low) * sines.step;
    const std::vector<ActiveRows> active = active_rows_of(is_active);
    Array<float, 2>& half = scratch.half;
    if (half.size() == 0) half = Array<float, 2>({optics::blocks_of(across(size_.reach_y)), active_columns * both});
    // Transforms each column and keeps only the frequencies within the pupil.
    work::parallel_for(optics::blocks_of(active_columns), [&](std::size_t block) {
        const std::size_t first = block * optics::block_lines,
                          count = std::min(optics::block_lines, active_columns - first);
        const std::size_t padded_rows = padded(plane.height);
        const core::ThreadBuffer<float> lines(padded_rows * both), together(sines.size_y * both);
        for (std::size_t rows = 0; rows < padded_rows; rows += optics::block_lines)
            for (const std::size_t part : {std::size_t{0}, optics::block_lines})
                transpose_block(&scratch.columns(block, rows / optics::block_lines, part), both, both,
                                &lines[rows * both + part]);
        // The point of sine n_y on the column of sine n_x is at the tangent n_y/√(1 − n_x² − n_y²).
        const double row_of_eye = plane.row(eye.y), rows_per_tangent = -eye.z / plane.pitch_y;
        TangentPositions places{0, sines.step, row_of_eye, {}, {}};
        places.scales.fill(rows_per_tangent);
        for (std::size_t c = 0; c < optics::block_lines; ++c) {
            const auto column = static_cast<double>(size_.active_left + first + std::min(c, count - 1));
            const double sine = sines.first_x + column * sines.step;
            places.squares[c] = 1 - sine * sine;
        }
        const auto [least, most] = std::ranges::minmax(places.squares);
        // The sine of a row at the tangent v is v √(1 − n_x²)/√(1 + v²).
        const auto sine_of = [&](double row, double square) {
            const double tangent = (row - row_of_eye) / rows_per_tangent;
            const double sine = tangent * std::sqrt(square) / std::hypot(1.0, tangent);
            return std::clamp((sine - low) / sines.step, 0.0, static_cast<double>(active_rows));
        };
        std::fill_n(together.data(), sines.size_y * both, 0.0f);
        for (const ActiveRows& rows : active) {
            const bool all = rows.begin < 0 && rows.end > static_cast<double>(plane.height);
            const double lowest = std::min(sine_of(rows.end, least), sine_of(rows.end, most)),
                         highest = std::max(sine_of(rows.begin, least), sine_of(rows.begin, most));
            const std::size_t from = all ? 0 : static_cast<std::size_t>(lowest),
                              to = all ? active_rows : static_cast<std::size_t>(std::ceil(highest));
            places.first = low + static_cast<double>(from) * sines.step;
            resample_lines(lines.data(), plane.height, places, interpolation(), to - from,
                           &together[(size_.active_low + from) * both]);
        }
        down_.transform(together.data());
        transpose_selected(together.data(), frequencies_y_, count, &half(0, first * both), half.extent(1));
    });
}

void Film::expose(std::span<const PupilWave> pupil_waves, const Camera& camera, View<float, 2> intensity) const {
    if (pupil_waves.empty()) return;
    const FilmLens lens(size_.sines, hologram_.wavelength, camera);
    // Between nodes the intensities are blended linearly.
    const auto share = [&](const FilmAxis& axis, const SineGrid::Range& sines, std::size_t k, std::size_t at,
                           std::size_t nodes) {
        const double sine = axis.low + static_cast<double>(k) * axis.step;
        const double place = lens.among_nodes((sine - sines.low) / sines.span(), nodes);
        return static_cast<float>(std::max(0.0, 1 - std::abs(place - static_cast<double>(at))));
    };
    const std::ptrdiff_t reach_y = std::min(lens.reach_y(), size_.reach_y);
    Node node;
    node.reach_x = std::min(lens.reach_x(), size_.reach_x);
    const auto first_row = static_cast<std::size_t>(size_.reach_y - reach_y), end_row = first_row + across(reach_y);
    node.first_block = first_row / optics::block_lines;
    node.lens = Array<float, 2>({optics::blocks_of(end_row) - node.first_block, across(node.reach_x) * both});
    node.share_x = Array<float, 1>({padded(size_.x.count)});
    node.share_y.resize(size_.y.count);
    for (std::size_t b = 0; b < lens.nodes_y; ++b)
        for (std::size_t a = 0; a < lens.nodes_x; ++a) {
            work::parallel_for(node.lens.extent(0), [&](std::size_t block) {
                const auto first = static_cast<std::ptrdiff_t>((node.first_block + block) * optics::block_lines);
                lens.rows(lens.node_x(a), lens.node_y(b), first - size_.reach_y, node.reach_x, &node.lens(block, 0));
            });
            for (std::size_t i = 0; i < size_.x.count; ++i)
                node.share_x(i) = share(size_.x, size_.sines.shown_x, i, a, lens.nodes_x);
            for (std::size_t j = 0; j < size_.y.count; ++j)
                node.share_y[j] = share(size_.y, size_.sines.shown_y, j, b, lens.nodes_y);
            for (const PupilWave& wave : pupil_waves) expose_node(wave, node, intensity);
        }
}

void Film::expose_node(const PupilWave& pupil_wave, const Node& node, View<float, 2> intensity) const {
    const std::size_t width = across(node.reach_x), middle = width / 2, blocks = node.lens.extent(0);
    const std::size_t left = static_cast<std::size_t>(size_.reach_x) - middle;
    auto scratch = scratch_->take();
    Array<float, 2>& columns = scratch->film_columns;
    if (const Shape<2> shape{optics::blocks_of(size_.x.count), blocks * optics::block_lines * both};
        columns.shape() != shape)
        columns = Array<float, 2>(shape);
    // First the few rows of the opening, then each column, whose intensity is added at once.
    work::parallel_for(blocks, [&](std::size_t block) {
        const std::size_t size = film_along_.size();
        const core::ThreadBuffer<float> lines(size * both);
        const math::PackedComplex* wave = &pupil_wave(node.first_block + block, left * optics::block_lines);
        const float* lens = &node.lens(block, 0);
        times_lens(wave + middle * optics::block_lines, lens + middle * both, middle + 1, lines.data());
        std::fill_n(&lines[(middle + 1) * both], (size - width) * both, 0.0f);
        times_lens(wave, lens, middle, lines.data() + (size - middle) * both);
        film_along_.transform(lines.data());
        transpose_selected(lines.data(), film_x_, optics::block_lines, &columns(0, block * optics::block_lines * both),
                           columns.extent(1));
    });
    // Row zero of the columns is the frequency −reach_y + 16 first_block.
    const std::size_t rows = blocks * optics::block_lines,
                      below = static_cast<std::size_t>(size_.reach_y) - node.first_block * optics::block_lines;
    work::parallel_for(columns.extent(0), [&](std::size_t block) {
        const std::size_t size = film_down_.size(), kept = std::min(rows - below, size - below);
        const core::ThreadBuffer<float> lines(size * both);
        std::copy_n(&columns(block, below * both), kept * both, lines.data());
        std::fill_n(lines.data() + kept * both, (size - below - kept) * both, 0.0f);
        std::copy_n(&columns(block, 0), below * both, lines.data() + (size - below) * both);
        film_down_.transform(lines.data());
        add_intensities(lines.data(), film_y_, &node.share_x(block * optics::block_lines), node.share_y,
                        &intensity(block, 0));
    });
}

}  // namespace hogel::camera::film
