// SPDX-License-Identifier: Apache-2.0
#include "hogel/stereogram/frequency_grid.h"
#include "hogel/core/thread_buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "hogel/error.h"
#include "hogel/stereogram/lobes.h"

namespace hogel::stereogram {
namespace {

// Maximum number of rays and lobes of a band: 128 KiB for sixteen hogels.
constexpr std::size_t max_band_size = 2048;

// Integral from −∞ to x of the hat function max(0, 1 − |x|).
double hat_integral(double x) {
    if (x <= -1) return 0;
    if (x >= 1) return 1;
    return x < 0 ? 0.5 * (1 + x) * (1 + x) : 1 - 0.5 * (1 - x) * (1 - x);
}

struct LobeWeights {
    std::size_t first = 0;
    std::vector<float> weights;  // empty: outside the field of view
};

// Computes the weights of samples 0..count−1 in the mean over [low, high] of their piecewise linear function. The end
// samples extend to the ends of their cells; beyond them the function is zero.
void linear_weights(double low, double high, std::size_t count, LobeWeights& result) {
    const double begin = -0.5, end = static_cast<double>(count) - 0.5;
    const double inside_low = std::max(low, begin), inside_high = std::min(high, end);
    result.weights.clear();
    if (!(inside_low < inside_high)) return;
    const double last = static_cast<double>(count) - 1;
    const double first = std::clamp(std::floor(inside_low), 0.0, last),
                 final = std::clamp(std::ceil(inside_high), 0.0, last);
    result.first = static_cast<std::size_t>(first);
    for (double k = first; k <= final; ++k) {
        double weight = hat_integral(inside_high - k) - hat_integral(inside_low - k);
        // Beyond an end sample its value stays constant.
        if (k == 0 && inside_low < 0)
            weight += std::min(inside_high, 0.0) - inside_low -
                      (hat_integral(std::min(inside_high, 0.0)) - hat_integral(inside_low));
        if (k == last && inside_high > last) {
            const double from = std::max(inside_low, last) - last, to = inside_high - last;
            weight += to - from - (hat_integral(to) - hat_integral(from));
        }
        result.weights.push_back(static_cast<float>(weight / (high - low)));
    }
}

// Computes the weights of samples in the mean over [low, high] of the function that is constant over each cell.
void constant_weights(double low, double high, std::size_t count, LobeWeights& result) {
    const double begin = std::max(low, -0.5), end = std::min(high, static_cast<double>(count) - 0.5);
    result.weights.clear();
    if (!(begin < end)) return;
    const double first = std::floor(begin + 0.5),
                 final = std::min(std::floor(end + 0.5), static_cast<double>(count) - 1);
    result.first = static_cast<std::size_t>(first);
    for (double k = first; k <= final; ++k)
        result.weights.push_back(
            static_cast<float>((std::min(end, k + 0.5) - std::max(begin, k - 0.5)) / (high - low)));
}

// Pads every lobe with zeros to the same number of weights: processors predict loops of constant length.
void pad_weights(LobeWeights& average, std::size_t weights, std::size_t count) {
    const std::size_t first = std::min(average.first, count - weights);
    average.weights.insert(average.weights.begin(), average.first - first, 0.0f);
    average.weights.resize(weights);
    average.first = first;
}

}  // namespace

FrequencyGrid::FrequencyGrid(const LightFieldGrid& light_field, std::size_t samples, double wavelength,
                             Interpolation interpolation)
    : FrequencyGrid(light_field, samples, samples, wavelength / light_field.pitch, wavelength, interpolation) {}

FrequencyGrid::FrequencyGrid(std::span<const LightFieldGrid> faces, std::size_t samples, double wavelength,
                             Interpolation interpolation)
    : FrequencyGrid(faces, samples, samples, wavelength / faces.front().pitch, wavelength, interpolation) {}

FrequencyGrid::FrequencyGrid(std::span<const LightFieldGrid> faces, std::size_t rows, std::size_t columns,
                             double step_y, double wavelength, Interpolation interpolation)
    : rows_(rows), columns_(columns), rays_(0), row_length_(0) {
    for (const LightFieldGrid& face : faces) rays_ += face.directions();
    resampling_ = scatter_lobes(faces, columns, step_y, rows == 1, wavelength, interpolation);
    bands_ = {{0, resampling_.lobes.size(), 0, rays_}};
    list_runs();
}

FrequencyGrid FrequencyGrid::of_line(std::span<const LightFieldGrid> faces, std::size_t samples, double line_pitch,
                                     double wavelength, Interpolation interpolation) {
    if (faces.size() > 1) return {faces, 1, samples, wavelength / line_pitch, wavelength, interpolation};
    return {faces.front(), 1, samples, wavelength / line_pitch, wavelength, interpolation};
}

FrequencyGrid::FrequencyGrid(const LightFieldGrid& light_field, std::size_t rows, std::size_t columns, double step_y,
                             double wavelength, Interpolation interpolation)
    : rows_(rows), columns_(columns), rays_(light_field.directions()), row_length_(light_field.directions_u) {
    const double step = wavelength / light_field.pitch;  // between frequencies, as a direction sine
    const auto width = static_cast<std::ptrdiff_t>(columns), height = static_cast<std::ptrdiff_t>(rows);
    const bool has_sines = light_field.has_frequencies();
    const auto mean = interpolation == Interpolation::constant || is_frequency_grid(light_field, wavelength)
                          ? constant_weights
                          : linear_weights;
    LobeWeights u, v;
    // Calls use(coefficient, scale) for each active frequency, with its weights in u and v.
    const auto for_each_lobe = [&](const auto& use) {
        // Frequency −n/2 of an even grid would be its own mirror image and is omitted.
        const std::ptrdiff_t max_x = (width - 1) / 2, max_y = (height - 1) / 2;
        for (std::ptrdiff_t jy = -max_y; jy <= max_y; ++jy)
            for (std::ptrdiff_t jx = -max_x; jx <= max_x; ++jx) {
                const double sx = step * static_cast<double>(jx), sy = step * static_cast<double>(jy);
                const double cos2 = 1 - sx * sx - sy * sy;
                if (cos2 <= 0) continue;
                const double cosine = std::sqrt(cos2);
                const double U = -sx / (has_sines ? 1 : cosine), V = -sy / (has_sines ? 1 : cosine);
                // Width of the lobe in U and V: dU/dsx = (1 + U²)/cos θ.
                const double wu = 0.5 * step * (has_sines ? 1 : (1 + U * U) / cosine);
                const double wv = 0.5 * step * (has_sines ? 1 : (1 + V * V) / cosine);
                mean(light_field.column(U - wu), light_field.column(U + wu), light_field.directions_u, u);
                // The one row of directions of a line stands for all vertical angles.
                if (rows == 1)
                    v = {0, {1.0f}};
                else
                    mean(light_field.row(V + wv), light_field.row(V - wv), light_field.directions_v, v);
                if (u.weights.empty() || v.weights.empty()) continue;
                // DFT rows run downwards, y upwards: the row is −j_y.
                const auto row = static_cast<std::size_t>((height - jy) % height),
                           column = static_cast<std::size_t>((width + jx) % width);
                use(static_cast<std::uint32_t>(row * columns + column), static_cast<float>(step * step_y / cosine));
            }
    };
    // First pass: counts lobes and weights. A hogel may have 10⁸ lobes, so the second pass stores into reserved arrays.
    std::size_t lobes = 0, max_u = 0, max_v = 0;
    for_each_lobe([&](std::uint32_t, float) {
        ++lobes;
        max_u = std::max(max_u, u.weights.size());
        max_v = std::max(max_v, v.weights.size());
    });
    if (lobes > UINT32_MAX / std::max<std::size_t>(max_u + max_v, 1))
        throw Error(ErrorCode::usage,
                    fmt::format("hogels of {}x{} samples have {} active frequencies, too many for one transform; "
                                "use smaller hogels",
                                columns, rows, lobes));
    lobes_.reserve(lobes);
    weights_.reserve(lobes * (max_u + max_v));
    for_each_lobe([&](std::uint32_t coefficient, float scale) {
        pad_weights(u, max_u, light_field.directions_u);
        pad_weights(v, max_v, rows == 1 ? 1 : light_field.directions_v);
        lobes_.push_back({coefficient, static_cast<std::uint32_t>(u.first), static_cast<std::uint32_t>(v.first),
                          static_cast<std::uint32_t>(max_u), static_cast<std::uint32_t>(max_v),
                          static_cast<std::uint32_t>(weights_.size()), scale});
        weights_.insert(weights_.end(), u.weights.begin(), u.weights.end());
        weights_.insert(weights_.end(), v.weights.begin(), v.weights.end());
    });
    list_bands();
    list_runs();
}

// Combines consecutive rows of frequencies, with lobes in neighbouring rows of directions, into bands of limited size.
void FrequencyGrid::list_bands() {
    for (std::size_t first = 0, end = 0; first < lobes_.size(); first = end) {
        const std::size_t row = lobes_[first].coefficient / columns_;
        std::size_t low = rays_, high = 0;
        for (; end < lobes_.size() && lobes_[end].coefficient / columns_ == row; ++end) {
            low = std::min(low, lobes_[end].v0 * row_length_);
            high = std::max(high, (lobes_[end].v0 + lobes_[end].nv) * row_length_);
        }
        if (!bands_.empty()) {
            Band& last = bands_.back();
            const std::size_t from = std::min(last.ray0, low), to = std::max(last.ray0 + last.rays, high);
            if (to - from + end - last.lobe0 <= max_band_size) {
                last = {last.lobe0, end - last.lobe0, from, to - from};
                continue;
            }
        }
        bands_.push_back({first, end - first, low, high - low});
    }
    for (const Band& band : bands_)
        for (Lobe& lobe : std::span(lobes_).subspan(band.lobe0, band.lobes))
            lobe.v0 -= static_cast<std::uint32_t>(band.ray0 / row_length_);
}

void FrequencyGrid::list_runs() {
    for (Band& band : bands_) {
        band.run0 = runs_.size();
        for (std::size_t lobe = band.lobe0; lobe < band.lobe0 + band.lobes; ++lobe) {
            const auto row = static_cast<std::uint32_t>(coefficient(lobe) / columns_),
                       column = static_cast<std::uint32_t>(coefficient(lobe) % columns_);
            if (runs_.size() > band.run0 && runs_.back().row == row &&
                runs_.back().column + runs_.back().count == column)
                ++runs_.back().count;
            else
                runs_.push_back({static_cast<std::uint32_t>(lobe), row, column, 1});
        }
        band.runs = runs_.size() - band.run0;
    }
}

std::vector<bool> FrequencyGrid::active_rows() const {
    std::vector<bool> active(rows_);
    for (const Run& run : runs_) active[run.row] = true;
    return active;
}

bool is_frequency_grid(const LightFieldGrid& light_field, double wavelength) {
    const auto fits = [&](double step, double middle) {
        return std::abs(step * light_field.pitch / wavelength - 1) < 1e-6 &&
               std::abs(middle - std::round(middle)) < 1e-6;
    };
    return light_field.has_frequencies() && fits(light_field.step_u(), light_field.column(0)) &&
           fits(light_field.step_v(), light_field.row(0));
}

void FrequencyGrid::amplitudes(std::span<const float> radiance, std::span<float> moduli) const {
    amplitudes(View<const float, 2>(radiance.data(), {1, radiance.size()}),
               View<float, 2>(moduli.data(), {1, moduli.size()}));
}

void FrequencyGrid::amplitudes(View<const float, 2> radiances, View<float, 2> moduli) const {
    average(radiances, false, moduli);
}

void FrequencyGrid::amplitudes_of_roots(View<const float, 2> roots, View<float, 2> moduli) const {
    average(roots, true, moduli);
}

void FrequencyGrid::average(View<const float, 2> values, bool of_roots, View<float, 2> moduli) const {
    std::fill(moduli.elements().begin(), moduli.elements().end(), 0.0f);
    Array<float, 2> line({columns_, hogels_at_once});
    for (std::size_t first = 0; first < values.extent(0); first += hogels_at_once) {
        const std::size_t hogels = std::min(hogels_at_once, values.extent(0) - first);
        std::optional<std::size_t> pending_row;
        const auto store_row = [&] {
            if (pending_row)
                transpose(line.data(), hogels_at_once, columns_, hogels, &moduli(first, *pending_row * columns_),
                          coefficients());
        };
        amplitudes_by_rows({&values(first, 0), {hogels, values.extent(1)}}, of_roots, [&](std::size_t row) {
            store_row();
            pending_row = row;
            return line.data();
        });
        store_row();
    }
}

void FrequencyGrid::average_run(std::size_t lobe, std::size_t count, View<const float, 2> transposed, bool of_roots,
                                float* out) const {
    if (lobes_.empty())
        average_scattered(resampling_, lobe, count, transposed, of_roots, out);
    else
        average_lobes(std::span(lobes_).subspan(lobe, count), weights_.data(), transposed.data(), row_length_, of_roots,
                      out);
}

// Processes sixteen hogels side by side, which turns the lobes' short, irregular sums into sums of whole vectors.
void FrequencyGrid::amplitudes_by_rows(View<const float, 2> values, bool of_roots,
                                       const RowDestination& destination) const {
    std::size_t max_rays = 0;
    for (const Band& band : bands_) max_rays = std::max(max_rays, band.rays);
    const core::ThreadBuffer<float> scratch(max_rays * hogels_at_once);
    const View<float, 2> transposed(scratch.data(), {max_rays, hogels_at_once});
    for (const Band& band : bands_) {
        transpose(&values(0, band.ray0), rays_, values.extent(0), band.rays, transposed.data(), hogels_at_once);
        const std::span runs = std::span(runs_).subspan(band.run0, band.runs);
        for (std::size_t first = 0, end = 0; first < runs.size(); first = end) {
            std::size_t active = 0;
            for (end = first; end < runs.size() && runs[end].row == runs[first].row; ++end) active += runs[end].count;
            float* line = destination(runs[first].row);
            if (active < columns_) std::fill_n(line, columns_ * hogels_at_once, 0.0f);
            for (const Run& run : runs.subspan(first, end - first))
                average_run(run.lobe, run.count, transposed, of_roots, line + run.column * hogels_at_once);
        }
    }
}

void transpose_plain(const float* from, std::size_t from_stride, std::size_t rows, std::size_t columns, float* to,
                     std::size_t to_stride) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            to[column * to_stride + row] = from[row * from_stride + column];
}

void average_lobes_plain(std::span<const FrequencyGrid::Lobe> lobes, const float* weights, const float* rays,
                         std::size_t row_length, bool of_roots, float* out) {
    for (const FrequencyGrid::Lobe& lobe : lobes) {
        const float* u = weights + lobe.weights;
        const float* v = u + lobe.nu;
        for (std::size_t hogel = 0; hogel < hogels_at_once; ++hogel) {
            float sum = 0;
            for (std::uint32_t l = 0; l < lobe.nv; ++l) {
                const float* row = rays + ((lobe.v0 + l) * row_length + lobe.u0) * hogels_at_once + hogel;
                float line = 0;
                for (std::uint32_t k = 0; k < lobe.nu; ++k) line += u[k] * row[k * hogels_at_once];
                sum += v[l] * line;
            }
            // Small negative values of decoded light fields count as zero.
            *out++ = of_roots ? sum * std::sqrt(lobe.scale) : std::sqrt(std::max(sum, 0.0f) * lobe.scale);
        }
    }
}

}  // namespace hogel::stereogram
