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

std::size_t count_frequencies(std::ptrdiff_t reach) { return static_cast<std::size_t>(2 * reach + 1); }

constexpr std::size_t padded(std::size_t lines) { return optics::blocks_of(lines) * optics::block_lines; }

constexpr std::size_t complex_row = math::SplitFft::row;
static_assert(complex_row == 2 * optics::block_lines && optics::block_lines == PackedBand::side);

FilmAxis film_axis(double first, double period, const SineGrid::Range& shown, std::size_t frequencies, double samples) {
    FilmAxis axis;
    const double min_size = std::ceil(samples * period);
    axis.size = math::good_fft_size(std::max(frequencies, static_cast<std::size_t>(min_size)));
    axis.step = period / static_cast<double>(axis.size);
    const double last = static_cast<double>(axis.size);
    const double begin = std::clamp(std::floor((shown.low - first) / axis.step) - TwelvePoint::taps, 0.0, last),
                 end = std::clamp(std::ceil((shown.high - first) / axis.step) + TwelvePoint::taps, 0.0, last);
    axis.first = static_cast<std::size_t>(begin);
    axis.count = static_cast<std::size_t>(end) - axis.first;
    axis.low = first + begin * axis.step;
    return axis;
}

// A range of active rows of a band, [begin, end), widened by the kernel of the resampling.
struct ActiveRows {
    double begin, end;
};
std::vector<ActiveRows> active_rows_of(const std::vector<char>& is_active) {
    std::vector<ActiveRows> ranges;
    for (std::size_t row = 0; row < is_active.size(); ++row) {
        if (!is_active[row]) continue;
        constexpr double margin = InterpolationTable::taps;
        const double begin = static_cast<double>(row) - margin, end = static_cast<double>(row) + margin;
        if (!ranges.empty() && begin <= ranges.back().end)
            ranges.back().end = end;
        else
            ranges.push_back({begin, end});
    }
    return ranges;
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
    x = film_axis(sines.first_x, sines.period_x(), sines.shown_x, count_frequencies(reach_x),
                  samples * pupil / wavelength);
    y = film_axis(sines.first_y, sines.period_y(), sines.shown_y, count_frequencies(reach_y),
                  samples * pupil / wavelength);
    Grid margin_plane = band.plane;
    margin_plane.width += 2 * InterpolationTable::taps;
    margin_plane.height += 2 * InterpolationTable::taps;
    const SineRanges active = sines_of(band.geometry, margin_plane);
    const auto index = [&](double sine, double first, std::size_t size) {
        return static_cast<std::size_t>(std::clamp(std::ceil((sine - first) / sines.step), 0.0, double(size)));
    };
    active_left = index(active.x.low, sines.first_x, sines.size_x);
    active_right = index(active.x.high, sines.first_x, sines.size_x);
    active_low = index(active.y.low, sines.first_y, sines.size_y);
    active_high = index(active.y.high, sines.first_y, sines.size_y);
}

double FilmSize::pupil_bytes() const {
    return static_cast<double>(sizeof(math::PackedComplex) * count_frequencies(reach_x) *
                               padded(count_frequencies(reach_y)));
}

double FilmSize::work_bytes() const {
    // All of these are reused for the next look.
    const double lens_bytes = 2 * pupil_bytes();
    const std::size_t to_pupil = (active_right - active_left) * (band_rows + padded(count_frequencies(reach_y))),
                      to_film = padded(x.count) * padded(count_frequencies(reach_y));
    return static_cast<double>(sizeof(Complex) * (to_pupil + to_film)) + lens_bytes;
}

double FilmSize::intensity_bytes() const { return static_cast<double>(sizeof(float) * padded(x.count) * y.count); }

Film::Film(const narrow_band::BandGrid& band, const FieldGrid& hologram, const Rectangle& shown, double pupil,
           double blur, double samples)
    : band_(band),
      hologram_(hologram),
      size_(band, hologram, shown, pupil, blur, samples),
      fft_x_(size_.sines.size_x),
      fft_y_(size_.sines.size_y),
      film_fft_x_(size_.x.size),
      film_fft_y_(size_.y.size),
      scratch_(std::make_unique<core::ObjectPool<Scratch>>()) {
    for (std::ptrdiff_t k = -size_.reach_x; k <= size_.reach_x; ++k)
        frequencies_x_.push_back(fft_x_.place(optics::wrapped(k, fft_x_.size())));
    for (std::ptrdiff_t k = -size_.reach_y; k <= size_.reach_y; ++k)
        frequencies_y_.push_back(fft_y_.place(optics::wrapped(k, fft_y_.size())));
    for (std::size_t i = 0; i < size_.x.count; ++i) film_x_.push_back(film_fft_x_.place(size_.x.first + i));
    for (std::size_t j = 0; j < size_.y.count; ++j) film_y_.push_back(film_fft_y_.place(size_.y.first + j));
}

PupilWave Film::pupil_wave(const PackedBand& band) const {
    // Two passes, each along one axis: first to uniform n_x on the band's rows, then down the columns of constant n_x
    // to uniform n_y. The intermediate result is transposed, so that both passes run along memory.
    auto scratch = scratch_->take();
    std::vector<char> is_active(band.height());
    resample_rows(band, is_active, *scratch);
    transform_columns(is_active, *scratch);
    const std::size_t active = size_.active_right - size_.active_left, width = count_frequencies(size_.reach_x);
    PupilWave wave({optics::blocks_of(count_frequencies(size_.reach_y)), width * optics::block_lines});
    work::parallel_for(wave.extent(0), [&](std::size_t block) {
        const core::ThreadBuffer<float> lines(fft_x_.size() * complex_row);
        std::fill_n(lines.data(), size_.active_left * complex_row, 0.0f);
        std::copy_n(&scratch->half(block, 0), active * complex_row, &lines[size_.active_left * complex_row]);
        std::fill_n(lines.data() + size_.active_right * complex_row, (fft_x_.size() - size_.active_right) * complex_row,
                    0.0f);
        fft_x_.transform(lines.data());
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
        scratch.columns =
            Array<float, 3>({optics::blocks_of(active_columns), row_blocks, optics::block_lines * complex_row});
    const Vec3 viewpoint = band_.geometry.eye();
    work::parallel_for(row_blocks, [&](std::size_t block) {
        const std::size_t first = block * optics::block_lines,
                          count = std::min(optics::block_lines, plane.height - first);
        // Most rows are zero where the lines of a hologram are photographed separately.
        bool all_zero = true;
        for (std::size_t r = first; r < first + count; ++r) {
            is_active[r] = band.is_active(r);
            all_zero = all_zero && !is_active[r];
        }
        if (all_zero) {
            for (std::size_t i = 0; i < scratch.columns.extent(0); ++i)
                std::ranges::fill(scratch.columns[i][block].elements(), 0.0f);
            return;
        }
        const core::ThreadBuffer<float> lines(padded(plane.width) * complex_row);
        interleave_rows(band.at(first, 0), optics::blocks_of(plane.width), lines.data());
        // On a row the point of sine n_x lies at x = c_x + n_x/√(1 − n_x²) · √((y − c_y)² + c_z²).
        TangentPositions positions{0, sines.step, plane.column(viewpoint.x), {}, {}};
        positions.squares.fill(1);
        for (std::size_t r = 0; r < optics::block_lines; ++r) {
            const auto row = static_cast<double>(first + std::min(r, count - 1));
            positions.scales[r] = std::hypot(plane.y(row) - viewpoint.y, viewpoint.z) / plane.pitch_x;
        }
        for (std::size_t i = 0; i < active_columns; i += optics::block_lines) {
            positions.first = sines.first_x + static_cast<double>(size_.active_left + i) * sines.step;
            resample_lines(lines.data(), plane.width, positions, interpolation(),
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
    const Vec3 viewpoint = band_.geometry.eye();
    const double low = sines.first_y + static_cast<double>(size_.active_low) * sines.step;
    const std::vector<ActiveRows> active = active_rows_of(is_active);
    Array<float, 2>& half = scratch.half;
    if (half.size() == 0)
        half = Array<float, 2>({optics::blocks_of(count_frequencies(size_.reach_y)), active_columns * complex_row});
    // Transforms each column and keeps only the frequencies within the pupil.
    work::parallel_for(optics::blocks_of(active_columns), [&](std::size_t block) {
        const std::size_t first = block * optics::block_lines,
                          count = std::min(optics::block_lines, active_columns - first);
        const std::size_t padded_rows = padded(plane.height);
        const core::ThreadBuffer<float> lines(padded_rows * complex_row), resampled(sines.size_y * complex_row);
        for (std::size_t rows = 0; rows < padded_rows; rows += optics::block_lines)
            for (const std::size_t part : {std::size_t{0}, optics::block_lines})
                transpose_block(&scratch.columns(block, rows / optics::block_lines, part), complex_row, complex_row,
                                &lines[rows * complex_row + part]);
        // The point of sine n_y on the column of sine n_x is at the tangent n_y/√(1 − n_x² − n_y²).
        const double viewpoint_row = plane.row(viewpoint.y), rows_per_tangent = -viewpoint.z / plane.pitch_y;
        TangentPositions positions{0, sines.step, viewpoint_row, {}, {}};
        positions.scales.fill(rows_per_tangent);
        for (std::size_t c = 0; c < optics::block_lines; ++c) {
            const auto column = static_cast<double>(size_.active_left + first + std::min(c, count - 1));
            const double sine = sines.first_x + column * sines.step;
            positions.squares[c] = 1 - sine * sine;
        }
        const auto [min_square, max_square] = std::ranges::minmax(positions.squares);
        // The sine of a row at the tangent v is v √(1 − n_x²)/√(1 + v²).
        const auto index_of = [&](double row, double square) {
            const double tangent = (row - viewpoint_row) / rows_per_tangent;
            const double sine = tangent * std::sqrt(square) / std::hypot(1.0, tangent);
            return std::clamp((sine - low) / sines.step, 0.0, static_cast<double>(active_rows));
        };
        std::fill_n(resampled.data(), sines.size_y * complex_row, 0.0f);
        for (const ActiveRows& rows : active) {
            const bool covers_all = rows.begin < 0 && rows.end > static_cast<double>(plane.height);
            const double min_index = std::min(index_of(rows.end, min_square), index_of(rows.end, max_square)),
                         max_index = std::max(index_of(rows.begin, min_square), index_of(rows.begin, max_square));
            const std::size_t begin = covers_all ? 0 : static_cast<std::size_t>(min_index),
                              end = covers_all ? active_rows : static_cast<std::size_t>(std::ceil(max_index));
            positions.first = low + static_cast<double>(begin) * sines.step;
            resample_lines(lines.data(), plane.height, positions, interpolation(), end - begin,
                           &resampled[(size_.active_low + begin) * complex_row]);
        }
        fft_y_.transform(resampled.data());
        transpose_selected(resampled.data(), frequencies_y_, count, &half(0, first * complex_row), half.extent(1));
    });
}

void Film::expose(std::span<const PupilWave> pupil_waves, const Camera& camera, View<float, 2> intensity) const {
    if (pupil_waves.empty()) return;
    const FilmLens lens(size_.sines, hologram_.wavelength, camera);
    // Intensities are blended linearly between nodes.
    const auto share = [&](const FilmAxis& axis, const SineGrid::Range& sines, std::size_t k, std::size_t node_index,
                           std::size_t nodes) {
        const double sine = axis.low + static_cast<double>(k) * axis.step;
        const double node_position = lens.node_position((sine - sines.low) / sines.span(), nodes);
        return static_cast<float>(std::max(0.0, 1 - std::abs(node_position - static_cast<double>(node_index))));
    };
    const std::ptrdiff_t reach_y = std::min(lens.reach_y(), size_.reach_y);
    Node node;
    node.reach_x = std::min(lens.reach_x(), size_.reach_x);
    const auto first_row = static_cast<std::size_t>(size_.reach_y - reach_y),
               end_row = first_row + count_frequencies(reach_y);
    node.first_block = first_row / optics::block_lines;
    node.lens =
        Array<float, 2>({optics::blocks_of(end_row) - node.first_block, count_frequencies(node.reach_x) * complex_row});
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
    const std::size_t width = count_frequencies(node.reach_x), middle = width / 2, blocks = node.lens.extent(0);
    const std::size_t left = static_cast<std::size_t>(size_.reach_x) - middle;
    auto scratch = scratch_->take();
    Array<float, 2>& columns = scratch->film_columns;
    if (const Shape<2> shape{optics::blocks_of(size_.x.count), blocks * optics::block_lines * complex_row};
        columns.shape() != shape)
        columns = Array<float, 2>(shape);
    // Transforms the few rows of the opening, then each column, and adds its intensity at once.
    work::parallel_for(blocks, [&](std::size_t block) {
        const std::size_t size = film_fft_x_.size();
        const core::ThreadBuffer<float> lines(size * complex_row);
        const math::PackedComplex* wave = &pupil_wave(node.first_block + block, left * optics::block_lines);
        const float* lens = &node.lens(block, 0);
        times_lens(wave + middle * optics::block_lines, lens + middle * complex_row, middle + 1, lines.data());
        std::fill_n(&lines[(middle + 1) * complex_row], (size - width) * complex_row, 0.0f);
        times_lens(wave, lens, middle, lines.data() + (size - middle) * complex_row);
        film_fft_x_.transform(lines.data());
        transpose_selected(lines.data(), film_x_, optics::block_lines,
                           &columns(0, block * optics::block_lines * complex_row), columns.extent(1));
    });
    // Row zero of the columns is the frequency −reach_y + 16 first_block.
    const std::size_t rows = blocks * optics::block_lines,
                      negative_rows = static_cast<std::size_t>(size_.reach_y) - node.first_block * optics::block_lines;
    work::parallel_for(columns.extent(0), [&](std::size_t block) {
        const std::size_t size = film_fft_y_.size(),
                          positive_rows = std::min(rows - negative_rows, size - negative_rows);
        const core::ThreadBuffer<float> lines(size * complex_row);
        std::copy_n(&columns(block, negative_rows * complex_row), positive_rows * complex_row, lines.data());
        std::fill_n(lines.data() + positive_rows * complex_row, (size - negative_rows - positive_rows) * complex_row,
                    0.0f);
        std::copy_n(&columns(block, 0), negative_rows * complex_row,
                    lines.data() + (size - negative_rows) * complex_row);
        film_fft_y_.transform(lines.data());
        add_intensities(lines.data(), film_y_, &node.share_x(block * optics::block_lines), node.share_y,
                        &intensity(block, 0));
    });
}

}  // namespace hogel::camera::film
