// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera/rays/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "hogel/camera/rays/ray_kernels.h"
#include "hogel/core/stop_scope.h"
#include "hogel/core/thread_buffer.h"
#include "hogel/lightfield/interpolation.h"
#include "hogel/resources.h"
#include "hogel/work/parallel.h"

namespace hogel::camera::rays {
namespace {

// Values per thread that lens points sample from one block at a time, which stay in the second-level cache until the
// pixels are exposed. A batch has at least this many points unless their samples exceed 64 MiB: every hogel is on a
// page of its own, which the next batch must find again.
constexpr std::size_t samples_per_batch = std::size_t{1} << 16, min_points_per_batch = 64,
                      max_batch_samples = std::size_t{1} << 24;

// Hogels of a row that all lens points sample before the next ones; their samples stay in the first-level cache.
constexpr std::size_t hogels_per_batch = 32;

constexpr std::pair<std::size_t, std::size_t> empty_range{0, 0};

double van_der_corput(std::size_t i, std::size_t base) {
    double value = 0, digit_value = 1;
    for (; i > 0; i /= base) {
        digit_value /= static_cast<double>(base);
        value += digit_value * static_cast<double>(i % base);
    }
    return value;
}

}  // namespace

HogelBlock block_of(View<const float, 5> radiance, std::size_t s0, std::size_t t0, const HogelRange& range) {
    HogelBlock block;
    block.range = range;
    block.hogel = radiance.extent(3) * radiance.extent(4);
    block.row = radiance.extent(2) * block.hogel;
    block.channel = radiance.extent(1) * block.row;
    block.radiance = radiance.data() + (range.t0 - t0) * block.row + (range.s0 - s0) * block.hogel;
    return block;
}

LoadedHogels load_hogels(const LightFieldSource& face, const HogelRange& range) {
    LoadedHogels loaded;
    if (const View<const float, 5> in_memory = face.in_memory(); in_memory.size() > 0) {
        loaded.block = block_of(in_memory, 0, 0, range);
        return loaded;
    }
    loaded.tile = LightFieldTile(face.grid(), range, false);
    face.read(loaded.tile);
    loaded.block = block_of(loaded.tile.radiance, range.s0, range.t0, range);
    return loaded;
}

// Returns points spread evenly over the pupil's disc (Halton sequence, mapped by equal areas). Each has its own
// position in the pixel, so that one set of rays averages over both the pupil and the pixel's area.
std::vector<Exposure::LensPoint> Exposure::lens_points(double pupil, std::size_t count) {
    std::vector<LensPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 65536 == 0) core::throw_if_stopped();
        const double radius = 0.5 * pupil * std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(count));
        const double angle = 2 * std::numbers::pi * van_der_corput(i, 2);
        points.push_back({radius * std::cos(angle), radius * std::sin(angle), van_der_corput(i + 1, 3) - 0.5,
                          van_der_corput(i + 1, 5) - 0.5});
    }
    return points;
}

Exposure::Exposure(std::vector<LightFieldGrid> faces, const Camera& camera, std::size_t lens_count,
                   Implementation implementation)
    : faces_(std::move(faces)),
      grid_(faces_.front()),
      camera_(camera),
      uses_vectors_(implementation == Implementation::fast && is_separable(grid_)),
      points_(lens_points(camera.pupil, lens_count)),
      film_({grid_.channels, camera.picture.height, camera.picture.width}) {}

std::pair<std::size_t, std::size_t> Exposure::Run::intersect(std::size_t first, std::size_t last) const {
    const std::size_t from = std::clamp(begin, first, last);
    return {from, std::clamp(end, from, last)};
}

std::pair<std::size_t, std::size_t> Exposure::Run::interpolated_from(std::size_t first, std::size_t count) const {
    const auto from = low.begin() + static_cast<std::ptrdiff_t>(begin),
               to = low.begin() + static_cast<std::ptrdiff_t>(end);
    const auto below = [](std::int32_t place, std::size_t bound) { return static_cast<std::size_t>(place) < bound; };
    const auto left = std::lower_bound(from, to, first, below),
               right = std::lower_bound(left, to, first + count, below);
    return {static_cast<std::size_t>(left - low.begin()), static_cast<std::size_t>(right - low.begin())};
}

template <class Index>
Exposure::Run Exposure::make_run(std::size_t count, std::size_t samples, const Index& index) {
    Run result{count, 0, samples > 1 ? std::size_t{1} : 0, std::vector<std::int32_t>(count), std::vector<float>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const lightfield::Interpolation position(index(i), samples);
        if (position.outside) continue;
        result.begin = std::min(result.begin, i);
        result.end = i + 1;
        result.low[i] = static_cast<std::int32_t>(position.low);
        result.high_weight[i] = position.high_weight;
    }
    return result;
}

Exposure::Rays Exposure::rays_of(const LensPoint& point) const {
    const LightFieldGrid& grid = grid_;
    const Grid& picture = camera_.picture;
    const double lens_x = camera_.eye.x + point.x, lens_y = camera_.eye.y + point.y, R = camera_.eye.z;
    // A ray from a lens point to the pixel's point of the plane in focus crosses the hologram plane at the pixel's
    // position plus a fraction of the lens point's offset.
    const double shift = 1 - R / (R + camera_.focus_depth);
    Rays rays;
    if (uses_vectors_) {
        rays.columns_of_directions = make_run(grid.hogels_s, grid.directions_u, [&](std::size_t i) {
            const auto s = static_cast<double>(i);
            return grid.of_hogel(s, 0).column((grid.s(s) - lens_x) / R);
        });
        rays.rows_of_directions = make_run(grid.hogels_t, grid.directions_v, [&](std::size_t j) {
            const auto t = static_cast<double>(j);
            return grid.of_hogel(0, t).row((grid.t(t) - lens_y) / R);
        });
    }
    rays.columns_of_hogels = make_run(picture.width, grid.hogels_s, [&](std::size_t column) {
        const double x = picture.x(static_cast<double>(column) + point.pixel_x) + shift * point.x;
        return x / grid.pitch + 0.5 * static_cast<double>(grid.hogels_s) - 0.5;
    });
    rays.rows_of_hogels = make_run(picture.height, grid.hogels_t, [&](std::size_t row) {
        const double y = picture.y(static_cast<double>(row) + point.pixel_y) + shift * point.y;
        return 0.5 * static_cast<double>(grid.hogels_t) - 0.5 - y / grid.pitch;
    });
    return rays;
}

std::size_t bytes_of_rays(const LightFieldGrid& grid, const Camera& camera) {
    const std::size_t positions = camera.picture.width + camera.picture.height + grid.hogels_s + grid.hogels_t;
    return positions * (sizeof(std::int32_t) + sizeof(float));
}

void Exposure::prepare(std::size_t first, std::size_t count) {
    const bool all_points = points_.size() * bytes_of_rays(grid_, camera_) <= max_cached_;
    const std::size_t begin = all_points ? 0 : first, size = all_points ? points_.size() : count;
    if (first_prepared_ != begin || prepared_.size() != size) {
        first_prepared_ = begin;
        prepared_.resize(size);
        work::parallel_for(size, [&](std::size_t i) { prepared_[i] = rays_of(points_[begin + i]); });
    }
    first_ = first;
    rays_ = std::span(prepared_).subspan(first - begin, count);
}

template <class Sampler>
void Exposure::add_points(const HogelRange& range, const HogelRange& cells, const Sampler& sampler) {
    const std::size_t samples_per_point = range.nt * grid_.channels * range.ns;
    const std::size_t min_points = std::min(min_points_per_batch,
                                            std::max<std::size_t>(max_batch_samples / samples_per_point, 1)),
                      points_per_batch = std::min(
                          std::max(thread_count() * samples_per_batch / samples_per_point, min_points), points_.size());
    for (std::size_t first = 0; first < points_.size(); first += points_per_batch) {
        const std::size_t count = std::min(points_per_batch, points_.size() - first);
        prepare(first, count);
        if (samples_.size() < count * samples_per_point) samples_.resize(count * samples_per_point);
        const View<float, 4> samples(samples_.data(), {count, range.nt, grid_.channels, range.ns});
        sampler(samples);
        std::size_t top = camera_.picture.height, bottom = 0;  // rows of pixels that rays from these cells reach
        for (const Rays& rays : rays_) {
            const auto [begin, end] = rays.rows_of_hogels.interpolated_from(cells.t0, cells.nt);
            if (begin == end) continue;
            top = std::min(top, begin);
            bottom = std::max(bottom, end);
        }
        if (top < bottom)
            work::parallel_for(bottom - top, [&](std::size_t row) { expose_row(top + row, range, cells, samples); });
    }
}

void Exposure::add(std::size_t face, const HogelBlock& block, const HogelRange& cells) {
    add_points(block.range, cells, [&](View<float, 4> samples) {
        if (face == 0 && uses_vectors_)
            work::parallel_for(block.range.nt, [&](std::size_t t) { sample_row(block, t, samples); });
        else
            work::parallel_for(rays_.size(),
                               [&](std::size_t i) { sample_hogels(face, block, points_[first_ + i], samples[i]); });
    });
}

void Exposure::add(const Views<float>& views, const HogelRange& hogels, const HogelRange& cells) {
    add_points(hogels, cells, [&](View<float, 4> samples) {
        work::parallel_for(hogels.nt, [&](std::size_t t) { sample_row(views, hogels, t, samples); });
    });
}

void Exposure::add(const Views<std::uint16_t>& views, const HogelRange& hogels, const HogelRange& cells) {
    add_points(hogels, cells, [&](View<float, 4> samples) {
        work::parallel_for(hogels.nt, [&](std::size_t t) { sample_row(views, hogels, t, samples); });
    });
}

// Whether an earlier face has this direction. Faces may overlap, and a direction belongs to the first face.
bool Exposure::in_earlier_face(std::size_t face, Vec3 direction) const {
    return std::any_of(faces_.begin(), faces_.begin() + static_cast<std::ptrdiff_t>(face),
                       [&](const LightFieldGrid& earlier) { return earlier.covers(direction); });
}

void Exposure::sample_hogels(std::size_t face, const HogelBlock& block, const LensPoint& point,
                             View<float, 3> samples) const {
    const LightFieldGrid& grid = faces_[face];
    const HogelRange& range = block.range;
    std::ranges::fill(samples.elements(), 0.0f);
    const double lens_x = camera_.eye.x + point.x, lens_y = camera_.eye.y + point.y, distance = camera_.eye.z;
    for (std::size_t t = 0; t < range.nt; ++t) {
        const double V = (grid.t(static_cast<double>(range.t0 + t)) - lens_y) / distance;
        for (std::size_t s = 0; s < range.ns; ++s) {
            const auto i = static_cast<double>(range.s0 + s), j = static_cast<double>(range.t0 + t);
            const double U = (grid.s(i) - lens_x) / distance;
            const Vec3 direction = to_face(grid.face(), {U, V, 1});
            if (!(direction.z > 0) || in_earlier_face(face, {U, V, 1})) continue;
            const double forward = grid.has_frequencies() ? length(direction) : direction.z;
            const LightFieldGrid hogel_grid = grid.of_hogel(i, j);
            const lightfield::Interpolation u(hogel_grid.column(direction.x / forward), grid.directions_u);
            const lightfield::Interpolation v(hogel_grid.row(direction.y / forward), grid.directions_v);
            if (u.outside || v.outside) continue;
            const std::size_t u1 = u.high(grid.directions_u), v1 = v.high(grid.directions_v);
            const float* hogel = block.radiance + t * block.row + s * block.hogel;
            for (std::size_t c = 0; c < grid.channels; ++c) {
                const View<const float, 2> directions(hogel + c * block.channel,
                                                      {grid.directions_v, grid.directions_u});
                const float top = lightfield::mix(directions(v.low, u.low), directions(v.low, u1), u.high_weight);
                const float bottom = lightfield::mix(directions(v1, u.low), directions(v1, u1), u.high_weight);
                samples(t, c, s) = lightfield::mix(top, bottom, v.high_weight);
            }
        }
    }
}

void Exposure::sample_row(const HogelBlock& block, std::size_t t, View<float, 4> samples) const {
    const HogelRange& range = block.range;
    const std::size_t row = range.t0 + t;
    for (std::size_t from = 0; from < range.ns; from += hogels_per_batch) {
        const std::size_t to = std::min(from + hogels_per_batch, range.ns);
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            const Run& columns = rays_[i].columns_of_directions;
            const Run& rows = rays_[i].rows_of_directions;
            const auto [begin, end] =
                rows.contains(row) ? columns.intersect(range.s0 + from, range.s0 + to) : empty_range;
            const auto v = static_cast<std::size_t>(rows.low[row]);
            for (std::size_t c = 0; c < grid_.channels; ++c) {
                const std::span<float> values = samples[i][t][c].elements().subspan(from, to - from);
                if (begin == end) {
                    std::ranges::fill(values, 0.0f);
                    continue;
                }
                const std::size_t first = begin - range.s0 - from, last = end - range.s0 - from;
                std::ranges::fill(values.first(first), 0.0f);
                std::ranges::fill(values.subspan(last), 0.0f);
                const float* hogel = block.radiance + c * block.channel + t * block.row + (from + first) * block.hogel;
                sample_between({hogel + v * grid_.directions_u, hogel + (v + rows.next) * grid_.directions_u,
                                block.hogel, columns.next, rows.high_weight[row]},
                               {std::span(columns.low).subspan(begin, end - begin),
                                std::span(columns.high_weight).subspan(begin, end - begin)},
                               values.subspan(first, last - first));
            }
        }
    }
}

template <class Sample>
void Exposure::sample_row(const Views<Sample>& views, const HogelRange& range, std::size_t t,
                          View<float, 4> samples) const {
    const std::size_t row = range.t0 + t, view = grid_.channels * grid_.hogels();
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        const Run& columns = rays_[i].columns_of_directions;
        const Run& rows = rays_[i].rows_of_directions;
        const auto [begin, end] = rows.contains(row) ? columns.intersect(range.s0, range.s0 + range.ns) : empty_range;
        if (begin == end) {
            std::ranges::fill(samples[i][t].elements(), 0.0f);
            continue;
        }
        for (std::size_t c = 0; c < grid_.channels; ++c) {
            const std::span<float> values = samples[i][t][c].elements();
            std::ranges::fill(values.first(begin - range.s0), 0.0f);
            std::ranges::fill(values.subspan(end - range.s0), 0.0f);
        }
        const auto v = static_cast<std::size_t>(rows.low[row]);
        // Samples neighbours between the same columns of directions together.
        for (std::size_t first = begin, last = begin; first < end; first = last) {
            const auto u = static_cast<std::size_t>(columns.low[first]);
            while (last < end && static_cast<std::size_t>(columns.low[last]) == u) ++last;
            const std::span<const float> weights = std::span(columns.high_weight).subspan(first, last - first);
            for (std::size_t c = 0; c < grid_.channels; ++c) {
                const std::size_t at = (c * grid_.hogels_t + row) * grid_.hogels_s + first;
                const auto direction = [&](std::size_t down, std::size_t across) {
                    return views.samples + (down * grid_.directions_u + across) * view + at;
                };
                sample_along({direction(v, u), direction(v, u + columns.next), direction(v + rows.next, u),
                              direction(v + rows.next, u + columns.next)},
                             weights, rows.high_weight[row],
                             samples[i][t][c].elements().subspan(first - range.s0, last - first));
            }
        }
    }
}

void Exposure::expose_row(std::size_t row, const HogelRange& range, const HogelRange& cells,
                          View<const float, 4> samples) {
    const core::ThreadBuffer<float> line_buffer(range.ns);
    const core::ThreadBuffer<std::int32_t> low_buffer(camera_.picture.width);
    const std::span<float> line(line_buffer.data(), range.ns);
    const std::span<std::int32_t> low(low_buffer.data(), low_buffer.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        const Run& rows = rays_[i].rows_of_hogels;
        const Run& columns = rays_[i].columns_of_hogels;
        if (row < rows.begin || row >= rows.end) continue;
        const auto t = static_cast<std::size_t>(rows.low[row]);
        if (t < cells.t0 || t >= cells.t0 + cells.nt) continue;
        const std::size_t t0 = t - range.t0, t1 = t0 + rows.next;
        const auto [begin, end] = columns.interpolated_from(cells.s0, cells.ns);
        if (begin == end) continue;
        // Range of hogels that these pixels interpolate.
        const std::size_t first = static_cast<std::size_t>(columns.low[begin]) - range.s0;
        const std::size_t last = static_cast<std::size_t>(columns.low[end - 1]) - range.s0 + columns.next;
        const std::span<const std::int32_t> columns_low = std::span(columns.low).subspan(begin, end - begin);
        const auto offset = static_cast<std::int32_t>(range.s0);
        std::ranges::transform(columns_low, low.begin(), [&](std::int32_t column_low) { return column_low - offset; });
        for (std::size_t c = 0; c < grid_.channels; ++c) {
            const std::span<const float> top = samples[i][t0][c].elements(), bottom = samples[i][t1][c].elements();
            const std::size_t count = last - first + 1;
            mix_lines(top.subspan(first, count), bottom.subspan(first, count), rows.high_weight[row],
                      line.subspan(first, count));
            add_between(line, columns.next,
                        {low.first(end - begin), std::span(columns.high_weight).subspan(begin, end - begin)},
                        film_[c][row].elements().subspan(begin, end - begin));
        }
    }
}

void Exposure::develop(Image& image) const {
    const float mean = 1 / static_cast<float>(points_.size());
    work::parallel_for(camera_.picture.height, [&](std::size_t row) {
        for (std::size_t column = 0; column < camera_.picture.width; ++column)
            for (std::size_t c = 0; c < grid_.channels; ++c)
                image.pixels(row, column, c) = film_(c, row, column) * mean;
    });
}

}  // namespace hogel::camera::rays
