// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hogel/math/fft.h"
#include "hogel/optics/lines.h"
#include "hogel/optics/multiply.h"
#include "hogel/optics/phase_walk.h"
#include "hogel/optics/spectrum_steps.h"
#include "hogel/units.h"
#include "hogel/work/parallel.h"
#include "hogel/work/steps.h"

namespace hogel::optics {
namespace {

using Complex = std::complex<float>;

// Returns e^{sign·2πi j (½ − N/2)/N} · scale for j = first … first + count − 1. This phase moves the origin from the
// first sample of a transform to the centre of the window.
// @param samples  N
// @param sign     −1 for the transform to the spectrum
std::vector<Complex> centring(std::ptrdiff_t first, std::size_t count, std::size_t samples, double sign, double scale) {
    std::vector<Complex> phases(count);
    const double n = static_cast<double>(samples);
    for (std::size_t i = 0; i < count; ++i) {
        const double j = static_cast<double>(first) + static_cast<double>(i);
        phases[i] = Complex(scale * unit_phasor(sign * std::fmod(j * (0.5 - 0.5 * n), n) / n));
    }
    return phases;
}

// Returns the range of frequency steps in [low, high] that n samples represent around a carrier.
std::pair<std::ptrdiff_t, std::ptrdiff_t> steps(double low, double high, double size, std::size_t n, double carrier) {
    const double half = 0.5 * static_cast<double>(n), middle = std::round(carrier * size);
    constexpr double rounding = 1e-6;
    const double first = std::max(std::ceil(low * size - rounding), middle - std::floor(half));
    const double last = std::min(std::floor(high * size + rounding), middle + std::ceil(half) - 1);
    if (!(first <= last))
        throw Error(ErrorCode::usage,
                    fmt::format("a pitch of {2} cannot sample waves between {0:.4g} and {1:.4g} cycles per mm",
                                low * 1e-3, high * 1e-3, format_length(size / static_cast<double>(n))));
    return {static_cast<std::ptrdiff_t>(first), static_cast<std::ptrdiff_t>(last)};
}

}  // namespace

Band Band::of(const Grid& plane) {
    const double x = 0.5 / plane.pitch_x, y = 0.5 / plane.pitch_y;
    return {-x, x, -y, y};
}

Wave::Wave(const FieldGrid& grid, const ScratchOptions& scratch) : grid_(grid) {
    validate(grid, ErrorCode::usage, "wave");
    samples = core::PagedArray({grid.plane.height, grid.plane.width}, scratch);
    rows = {0, grid.plane.height};
}

Wave::Wave(const FieldGrid& grid, core::PagedArray samples_of_rows, const distributed::LineRange& local_rows)
    : samples(std::move(samples_of_rows)), rows(local_rows), grid_(grid) {}

void Wave::read(const Region& region, std::size_t look, View<Complex, 2> out) const {
    validate(region, grid_, out.shape());
    if (look != 0) throw Error(ErrorCode::usage, fmt::format("a wave has one look, but look {} was read", look));
    for (std::size_t y = 0; y < region.height; ++y)
        std::copy_n(&samples.view()(region.y0 + y - rows.first, region.x0), region.width, &out(y, 0));
}

Grid padded(const Grid& plane, double size_x, double size_y) {
    Grid window = plane;
    const auto grown = [](std::size_t samples, double size, double pitch) {
        const auto wanted = static_cast<std::size_t>(std::ceil(size / pitch));
        std::size_t n = math::good_fft_size(std::max(wanted, samples));
        // An even number of samples must be added to keep the samples in the middle.
        while ((n - samples) % 2 != 0) n = math::good_fft_size(n + 1);
        return n;
    };
    window.width = grown(plane.width, size_x, plane.pitch_x);
    window.height = grown(plane.height, size_y, plane.pitch_y);
    return window;
}

namespace {

// Returns a spectrum without samples, and in `shape` its numbers of rows and columns.
Spectrum frame_of(const Grid& window, double wavelength, const Band& band, double carrier_x, double carrier_y,
                  Shape<2>& shape) {
    Spectrum result;
    result.window = window;
    result.wavelength = wavelength;
    const auto [first_column, last_column] = steps(band.low_x, band.high_x, window.size_x(), window.width, carrier_x);
    const auto [first_row, last_row] = steps(-band.high_y, -band.low_y, window.size_y(), window.height, -carrier_y);
    result.first_column = first_column;
    result.first_row = first_row;
    shape = {static_cast<std::size_t>(last_row - first_row + 1),
             static_cast<std::size_t>(last_column - first_column + 1)};
    return result;
}

}  // namespace

Spectrum empty_spectrum(const Grid& window, double wavelength, const Band& band, double carrier_x, double carrier_y,
                        const ScratchOptions& scratch) {
    Shape<2> shape{};
    Spectrum result = frame_of(window, wavelength, band, carrier_x, carrier_y, shape);
    result.samples = distributed::SharedPlane(shape[0], shape[1], 1, 1, scratch, nullptr);
    work::parallel_for(shape[0],
                       [&](std::size_t row) { std::fill_n(&result.samples.at(row, 0), shape[1], Complex(0)); });
    return result;
}

namespace {

Spectrum transformed(const FieldSource& source, std::size_t look, const Grid& window, const Band& band,
                     double carrier_x, double carrier_y, const ScratchOptions& scratch, const Progress& progress,
                     Communicator* communicator) {
    const Grid& plane = source.grid().plane;
    if (window.width < plane.width || window.height < plane.height || (window.width - plane.width) % 2 != 0 ||
        (window.height - plane.height) % 2 != 0 || window.pitch_x != plane.pitch_x || window.pitch_y != plane.pitch_y)
        throw Error(ErrorCode::usage,
                    fmt::format("a window of {}x{} samples cannot hold a field of {}x{} in its middle", window.width,
                                window.height, plane.width, plane.height));
    Shape<2> shape{};
    Spectrum result = frame_of(window, source.grid().wavelength, band, carrier_x, carrier_y, shape);
    const auto [rows, columns] = shape;
    result.window.center_x = plane.center_x;
    result.window.center_y = plane.center_y;
    const std::ptrdiff_t first_column = result.first_column, first_row = result.first_row;

    // Transforms the rows and keeps the columns of the band.
    const std::size_t group_rows = source.alignment() * std::max<std::size_t>(block_lines / source.alignment(), 1);
    result.samples = distributed::SharedPlane(std::max(plane.height, rows), columns, group_rows, spectrum_block_columns,
                                              scratch, communicator);
    distributed::SharedPlane& shared = result.samples;
    shared.begin_rows(plane.height);
    const distributed::LineRange local_rows = shared.local_rows(plane.height), local_columns = shared.local_columns();
    const math::Fft1 along(window.width), down(window.height);
    const std::vector<Complex> centre_x =
        centring(first_column, columns, window.width, -1, window.pitch_x * window.pitch_y);
    const std::size_t row_blocks = blocks_of(local_rows.count, group_rows),
                      all_blocks = row_blocks + blocks_of(local_columns.count);
    work::Steps steps(progress, all_blocks);
    const std::size_t left = (window.width - plane.width) / 2, above = (window.height - plane.height) / 2;
    work::parallel_for(row_blocks, [&](std::size_t block) {
        const std::size_t y0 = local_rows.first + block * group_rows,
                          height = std::min(group_rows, local_rows.end() - y0);
        Array<Complex, 2> lines({height, plane.width});
        source.read({0, y0, plane.width, height}, look, lines);
        Array<Complex, 1> line({window.width});
        std::vector<Complex> row(columns);
        for (std::size_t y = 0; y < height; ++y) {
            std::ranges::fill(line.elements(), Complex(0));
            std::copy_n(&lines(y, 0), plane.width, &line(left));
            along.forward(line.data());
            take_frequencies(line.data(), window.width, first_column, columns, row.data());
            multiply(row.data(), centre_x.data(), row);
            shared.put_row(y0 + y, row.data());
        }
        steps.report_one();
    });

    // Transforms the columns and keeps the rows of the band.
    shared.to_columns(plane.height);
    const std::vector<Complex> centre_y = centring(first_row, rows, window.height, -1, 1);
    const distributed::LocalColumns field_columns = shared.in_columns(plane.height),
                                    band_columns = shared.in_columns(rows);
    work::parallel_for(blocks_of(local_columns.count), [&](std::size_t block) {
        const std::size_t x0 = local_columns.first + block * block_lines,
                          width = std::min(block_lines, local_columns.end() - x0);
        Array<Complex, 2> lines({width, stride_of(window.height)});
        for (std::size_t y = 0; y < plane.height; ++y)
            for (std::size_t i = 0; i < width; ++i) lines(i, above + y) = field_columns(y, x0 + i);
        for (std::size_t i = 0; i < width; ++i) down.forward(&lines(i, 0));
        for (std::size_t r = 0; r < rows; ++r) {
            const std::size_t index = wrapped(first_row + static_cast<std::ptrdiff_t>(r), window.height);
            for (std::size_t i = 0; i < width; ++i) band_columns(r, x0 + i) = times(lines(i, index), centre_y[r]);
        }
        steps.report_one();
    });
    shared.begin_columns(rows);
    return result;
}

}  // namespace

Spectrum spectrum_of(const FieldSource& field, std::size_t look, const Grid& window, const Band& band,
                     const ScratchOptions& scratch, const Progress& progress, Communicator* communicator) {
    return transformed(field, look, window, band, 0, 0, scratch, progress, communicator);
}

Spectrum spectrum_of(const Wave& wave, const Grid& window, const Band& band, const ScratchOptions& scratch,
                     const Progress& progress, Communicator* communicator) {
    return transformed(wave, 0, window, band, wave.carrier_x, wave.carrier_y, scratch, progress, communicator);
}

Grid grid_of(const Spectrum& spectrum, std::size_t width, std::size_t height) {
    const Grid& window = spectrum.window;
    return {width,
            height,
            window.size_x() / static_cast<double>(width),
            window.size_y() / static_cast<double>(height),
            window.center_x,
            window.center_y};
}

namespace {

// Transform of a spectrum to samples: along columns, then along rows. The second step does not need the spectrum.
class ToWave {
  public:
    ToWave(const Spectrum& spectrum, std::size_t width, std::size_t height)
        : spectrum_(spectrum), width_(width), height_(height), columns_(spectrum.width()) {
        const std::size_t rows = spectrum.height();
        if (width < columns_ || height < rows)
            throw Error(ErrorCode::usage,
                        fmt::format("{}x{} samples are too few for {}x{} frequencies", width, height, columns_, rows));
        const Grid& window = spectrum.window;
        centre_x_ = centring(spectrum.first_column, columns_, width, 1, 1 / (window.size_x() * window.size_y()));
        centre_y_ = centring(spectrum.first_row, rows, height, 1, 1);
    }

    std::size_t columns() const { return columns_; }

    // Returns the wave without samples; `rows` are the rows that this rank will have.
    Wave frame(const distributed::LineRange& rows) const {
        Wave wave({grid_of(spectrum_, width_, height_), spectrum_.wavelength}, core::PagedArray(), rows);
        wave.carrier_x = spectrum_.frequency_x(static_cast<double>(columns_ / 2));
        wave.carrier_y = spectrum_.frequency_y(static_cast<double>(centre_y_.size() / 2));
        return wave;
    }

    // Transforms a range of columns.
    // @param destination  destination(y, x): the address of the result of row y, from column x on
    template <class Destination>
    void along_columns(const distributed::LineRange& across, const Destination& destination) const {
        const math::Fft1 down(height_);
        work::parallel_for(blocks_of(across.count), [&](std::size_t block) {
            const std::size_t x0 = across.first + block * block_lines, count = std::min(block_lines, across.end() - x0);
            Array<Complex, 2> lines({count, stride_of(height_)});
            for (std::size_t r = 0; r < centre_y_.size(); ++r) {
                const std::size_t index = wrapped(spectrum_.first_row + static_cast<std::ptrdiff_t>(r), height_);
                const Complex* const row = &spectrum_.samples.at(r, x0);
                for (std::size_t i = 0; i < count; ++i)
                    lines(i, index) = times(row[i], times(centre_y_[r], centre_x_[x0 + i]));
            }
            for (std::size_t i = 0; i < count; ++i) down.backward(&lines(i, 0));
            for (std::size_t y = 0; y < height_; ++y) {
                Complex* const row = destination(y, x0);
                for (std::size_t i = 0; i < count; ++i) row[i] = lines(i, y);
            }
        });
    }

    // Transforms the local columns, and transposes the plane to rows.
    distributed::SharedPlane to_rows(const ScratchOptions& scratch, Communicator* communicator) const {
        distributed::SharedPlane plane(height_, columns_, block_lines, spectrum_block_columns, scratch, communicator);
        along_columns(plane.local_columns(), [&](std::size_t y, std::size_t x) { return &plane.at(y, x); });
        plane.to_rows(height_);
        return plane;
    }

    // Transforms a range of rows in place.
    // @param row  row(y): the address of row y, which begins with the results of along_columns()
    template <class Row>
    void along_rows(const distributed::LineRange& rows, const Row& row) const {
        const math::Fft1 along(width_);
        work::parallel_for(blocks_of(rows.count), [&](std::size_t block) {
            Array<Complex, 1> line({width_});
            for (std::size_t i = block * block_lines; i < std::min((block + 1) * block_lines, rows.count); ++i) {
                std::ranges::fill(line.elements(), Complex(0));
                Complex* const samples = row(rows.first + i);
                put_frequencies(samples, columns_, line.data(), width_, spectrum_.first_column);
                along.backward(line.data());
                std::copy_n(line.data(), width_, samples);
            }
        });
    }

  private:
    const Spectrum& spectrum_;
    std::size_t width_, height_, columns_;
    std::vector<Complex> centre_x_, centre_y_;  // [column], [row]
};

core::PagedArray samples_of(std::size_t rows, std::size_t width, const ScratchOptions& scratch) {
    return rows > 0 ? core::PagedArray({rows, width}, scratch, core::Contents::unset) : core::PagedArray();
}

// Local rows of a wave that other ranks receive.
class RowsToSend {
  public:
    // Holds the smallest range that contains all rows of `range` wanted by any rank.
    RowsToSend(const distributed::LineRange& range, const Communicator& communicator,
               const std::function<distributed::LineRange(std::size_t)>& wanted, std::size_t width,
               const ScratchOptions& scratch)
        : rows_{range.end(), 0} {
        std::size_t end = range.first;
        for (std::size_t rank = 0; rank < communicator.size(); ++rank)
            if (const distributed::LineRange rows = common_lines(range, wanted(rank)); rows.count > 0) {
                rows_.first = std::min(rows_.first, rows.first);
                end = std::max(end, rows.end());
            }
        rows_.count = end - std::min(end, rows_.first);
        samples_ = samples_of(rows_.count, width, scratch);
    }

    const distributed::LineRange& rows() const { return rows_; }
    bool contains(std::size_t y) const { return y >= rows_.first && y < rows_.end(); }
    Complex* row(std::size_t y) { return &samples_.view()(y - rows_.first, 0); }

  private:
    distributed::LineRange rows_;
    core::PagedArray samples_;
};

}  // namespace

Wave wave_of(const Spectrum& spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch,
             Communicator* communicator) {
    const ToWave to_wave(spectrum, width, height);
    Wave wave = to_wave.frame({0, height});
    const auto row = [&](std::size_t y) { return &wave.samples.view()(y - wave.rows.first, 0); };
    if (communicator == nullptr) {
        // The columns are also transformed in place, in the left part of the result.
        wave.samples = samples_of(height, width, scratch);
        to_wave.along_columns({0, to_wave.columns()}, [&](std::size_t y, std::size_t x) { return row(y) + x; });
        to_wave.along_rows(wave.rows, row);
        return wave;
    }
    const distributed::SharedPlane shared = to_wave.to_rows(scratch, communicator);
    wave.rows = shared.local_rows(height);
    wave.samples = samples_of(wave.rows.count, width, scratch);
    to_wave.along_rows(wave.rows, [&](std::size_t y) {
        shared.get_row(y, row(y));
        return row(y);
    });
    return wave;
}

Wave wave_of(Spectrum spectrum, std::size_t width, std::size_t height, const ScratchOptions& scratch,
             Communicator& communicator, const std::function<distributed::LineRange(std::size_t)>& wanted) {
    const ToWave to_wave(spectrum, width, height);
    const distributed::SharedPlane shared = to_wave.to_rows(scratch, &communicator);
    Wave wave = to_wave.frame(wanted(communicator.rank()));
    spectrum.samples = distributed::SharedPlane();
    // Local rows before and after the rows that this rank wants.
    const distributed::LineRange local = shared.local_rows(height);
    const auto to_send = [&](const distributed::LineRange& range) {
        return RowsToSend(common_lines(local, range), communicator, wanted, width, scratch);
    };
    std::array<RowsToSend, 2> outer{to_send({0, wave.rows.first}),
                                    to_send({wave.rows.end(), height - wave.rows.end()})};
    wave.samples = samples_of(wave.rows.count, width, scratch);
    const auto row = [&](std::size_t y) {
        for (RowsToSend& rows : outer)
            if (rows.contains(y)) return rows.row(y);
        return &wave.samples.view()(y - wave.rows.first, 0);
    };
    for (const distributed::LineRange& rows : {outer[0].rows(), common_lines(local, wave.rows), outer[1].rows()})
        to_wave.along_rows(rows, [&](std::size_t y) {
            shared.get_row(y, row(y));
            return row(y);
        });
    distributed::send_rows(
        communicator, {height, width}, block_lines, wanted,
        [&](std::size_t y, Complex* to) {
            if (row(y) != to) std::copy_n(row(y), width, to);
        },
        row);
    return wave;
}

Spectrum gathered(Spectrum spectrum, Communicator& communicator, const ScratchOptions& scratch) {
    distributed::SharedPlane shared = std::move(spectrum.samples);
    const std::size_t rows = shared.rows(), columns = shared.columns();
    shared.to_rows(rows);
    if (communicator.is_root()) spectrum.samples = distributed::SharedPlane(rows, columns, 1, 1, scratch, nullptr);
    distributed::send_rows(
        communicator, {rows, columns}, block_lines,
        [&](std::size_t rank) {
            return distributed::LineRange{0, rank == 0 ? rows : 0};
        },
        [&](std::size_t y, Complex* row) { shared.get_row(y, row); },
        [&](std::size_t y) { return &spectrum.samples.at(y, 0); });
    return spectrum;
}

Band band_between(const Rectangle& from, const Rectangle& to, double distance, double wavelength) {
    const auto min_offset = [](double low, double high) {
        return low <= 0 && high >= 0 ? 0 : std::min(std::abs(low), std::abs(high));
    };
    const double dx_low = to.left - from.right, dx_high = to.right - from.left;
    const double dy_low = to.bottom - from.top, dy_high = to.top - from.bottom;
    const auto sines = [&](double low, double high, double other_low, double other_high) {
        // Away from the axis the sine is largest at the smallest other offset; towards the axis at the largest.
        const double other_min = min_offset(other_low, other_high),
                     other_max = std::max(std::abs(other_low), std::abs(other_high));
        const auto sine = [&](double offset, double other) { return offset / std::hypot(offset, other, distance); };
        return std::pair(sine(low, low < 0 ? other_min : other_max), sine(high, high > 0 ? other_min : other_max));
    };
    const auto x = sines(dx_low, dx_high, dy_low, dy_high), y = sines(dy_low, dy_high, dx_low, dx_high);
    return {x.first / wavelength, x.second / wavelength, y.first / wavelength, y.second / wavelength};
}

}  // namespace hogel::optics
