// SPDX-License-Identifier: Apache-2.0
#include "hogel/patterns/pupils/rays.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "hogel/error.h"
#include "hogel/work/parallel.h"

namespace hogel::patterns {
namespace {

// Weights of the two samples around a position in a line; samples outside of the line are dark.
struct Between {
    std::ptrdiff_t first;
    float lower, upper;
};

Between between(double position) {
    const double first = std::floor(position);
    const auto upper = static_cast<float>(position - first);
    return {static_cast<std::ptrdiff_t>(first), 1 - upper, upper};
}

// Weights of a line's samples for each sample of another one: a triangle as wide as the larger of both pitches.
struct Resampling {
    struct Sample {
        std::size_t first = 0;
        std::vector<float> weights;
    };
    std::vector<Sample> samples;

    // @param position  of each wanted sample, in samples of the line
    // @param step      distance of wanted samples, in samples of the line
    template <class Position>
    Resampling(std::size_t count, std::size_t line, double step, const Position& position) : samples(count) {
        const double width = std::max(1.0, step);
        for (std::size_t i = 0; i < count; ++i) {
            const double at = position(i);
            const auto from = static_cast<std::ptrdiff_t>(std::floor(at - width)) + 1;
            const auto until = static_cast<std::ptrdiff_t>(std::ceil(at + width)) - 1;
            double sum = 0;
            for (std::ptrdiff_t k = from; k <= until; ++k) sum += width - std::abs(static_cast<double>(k) - at);
            const std::ptrdiff_t last = std::min(until, static_cast<std::ptrdiff_t>(line) - 1);
            samples[i].first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, from));
            for (auto k = static_cast<std::ptrdiff_t>(samples[i].first); k <= last; ++k)
                samples[i].weights.push_back(static_cast<float>((width - std::abs(static_cast<double>(k) - at)) / sum));
        }
    }
};

// Depths that contain all but a fiftieth of the rays at each end; both 0 if no ray has a depth.
void find_depths(std::vector<float>& depths, PupilRange& range) {
    if (depths.empty()) return;
    const std::size_t skipped = depths.size() / 50;
    std::nth_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(skipped), depths.end());
    range.nearest = depths[skipped];
    std::nth_element(depths.begin(), depths.end() - 1 - static_cast<std::ptrdiff_t>(skipped), depths.end());
    range.farthest = depths[depths.size() - 1 - skipped];
}

}  // namespace

PupilRays::PupilRays(const LightFieldSource& light_field, std::size_t channel, double wavelength, double pixel_pitch)
    : grid_(light_field.grid()), views_({grid_.directions_v, grid_.directions_u, grid_.hogels_t, grid_.hogels_s}) {
    require_common_directions(grid_, ErrorCode::usage, "the encoding supervised");
    if (std::min(grid_.directions_u, grid_.directions_v) < 3)
        throw Error(ErrorCode::usage, "encoding",
                    "supervised needs a light field of at least 3x3 directions; use gradient for fewer");
    const double per_sine = pixel_pitch / wavelength;
    for (std::size_t l = 0; l < grid_.directions_v; ++l)
        for (std::size_t k = 0; k < grid_.directions_u; ++k) {
            const Vec3 ray = grid_.direction_of(grid_.u(static_cast<double>(k)), grid_.v(static_cast<double>(l)));
            const double size = length(ray);
            directions_.push_back({ray.x / ray.z, ray.y / ray.z, -ray.x / size * per_sine, ray.y / size * per_sine});
        }
    const Direction &first = directions_.front(), &last = directions_.back();
    const double steps_u = static_cast<double>(grid_.directions_u - 1),
                 steps_v = static_cast<double>(grid_.directions_v - 1);
    const double cell_x = std::abs(last.x - first.x) / steps_u, cell_y = std::abs(last.y - first.y) / steps_v;
    cell_ = std::max(cell_x, cell_y);
    range_.directions = {0.5 * (first.x + last.x), 0.5 * (first.y + last.y), 0};
    range_.half_x = 0.5 * (std::abs(last.x - first.x) + cell_x);
    range_.half_y = 0.5 * (std::abs(last.y - first.y) + cell_y);
    read_views(light_field, channel);
}

void PupilRays::read_views(const LightFieldSource& light_field, std::size_t channel) {
    const HogelRange tile = light_field.preferred_tile();
    const std::size_t across = (grid_.hogels_s + tile.ns - 1) / tile.ns,
                      down = (grid_.hogels_t + tile.nt - 1) / tile.nt;
    std::mutex mutex;
    std::vector<float> depths;
    work::parallel_for(across * down, [&](std::size_t index) {
        const std::size_t s0 = index % across * tile.ns, t0 = index / across * tile.nt;
        LightFieldTile part(grid_,
                            {s0, t0, std::min(tile.ns, grid_.hogels_s - s0), std::min(tile.nt, grid_.hogels_t - t0)},
                            light_field.has_depth());
        light_field.read(part);
        for (std::size_t t = 0; t < part.range.nt; ++t)
            for (std::size_t s = 0; s < part.range.ns; ++s)
                for (std::size_t v = 0; v < grid_.directions_v; ++v)
                    for (std::size_t u = 0; u < grid_.directions_u; ++u)
                        views_(v, u, t0 + t, s0 + s) = part.radiance(channel, t, s, v, u);
        std::vector<float> finite;
        const std::size_t middle_v = grid_.directions_v / 2, middle_u = grid_.directions_u / 2;
        for (std::size_t t = 0; part.depth.size() > 0 && t < part.range.nt; ++t)
            for (std::size_t s = 0; s < part.range.ns; ++s)
                if (const float depth = part.depth(t, s, middle_v, middle_u); std::isfinite(depth))
                    finite.push_back(depth);
        const std::lock_guard lock(mutex);
        depths.insert(depths.end(), finite.begin(), finite.end());
    });
    find_depths(depths, range_);
}

std::vector<PupilRays::Shifted> PupilRays::views_through(const Pupil& pupil) const {
    std::vector<Shifted> views;
    double sum = 0;
    const std::size_t hogels = grid_.hogels();
    for (std::size_t d = 0; d < directions_.size(); ++d) {
        const Direction& direction = directions_[d];
        const double distance = std::hypot(direction.x - pupil.aperture.x, direction.y - pupil.aperture.y);
        // Share of the direction's cell in the pupil.
        const double share = std::clamp((pupil.aperture.radius - distance) / cell_ + 0.5, 0.0, 1.0);
        if (share == 0) continue;
        sum += share;
        views.push_back({views_.data() + d * hogels, static_cast<float>(share),
                         -direction.u * pupil.focus / grid_.pitch, direction.v * pupil.focus / grid_.pitch});
    }
    for (Shifted& view : views) view.weight = static_cast<float>(view.weight / sum);
    return views;
}

void PupilRays::photograph(const Pupil& pupil, const PupilFilm& film, Array<float, 2>& radiance) const {
    const std::vector<Shifted> views = views_through(pupil);
    const std::size_t width = grid_.hogels_s, height = grid_.hogels_t;
    const double middle_s = 0.5 * static_cast<double>(width) - 0.5, middle_t = 0.5 * static_cast<double>(height) - 0.5;
    const Resampling across(film.columns(), width, film.pitch_x() / grid_.pitch,
                            [&](std::size_t i) { return film.x(i) / grid_.pitch + middle_s; });
    const Resampling down(film.rows(), height, film.pitch_y() / grid_.pitch,
                          [&](std::size_t j) { return middle_t - film.y(j) / grid_.pitch; });
    // The mean at the positions of hogels, resampled along each row.
    Array<float, 2> rows({height, film.columns()});
    work::parallel_for(height, [&](std::size_t t) {
        std::vector<float> line(width, 0.0f);
        for (const Shifted& view : views) {
            const Between row = between(static_cast<double>(t) + view.rows), column = between(view.columns);
            for (const auto& [j, weight] : {std::pair{row.first, row.lower}, std::pair{row.first + 1, row.upper}}) {
                if (j < 0 || j >= static_cast<std::ptrdiff_t>(height)) continue;
                const float* samples = view.view + static_cast<std::size_t>(j) * width;
                const auto n = static_cast<std::ptrdiff_t>(width);
                const float lower = view.weight * weight * column.lower, upper = view.weight * weight * column.upper;
                for (auto i = std::clamp<std::ptrdiff_t>(-column.first, 0, n),
                          end = std::clamp<std::ptrdiff_t>(n - column.first, 0, n);
                     i < end; ++i)
                    line[static_cast<std::size_t>(i)] += lower * samples[i + column.first];
                for (auto i = std::clamp<std::ptrdiff_t>(-column.first - 1, 0, n),
                          end = std::clamp<std::ptrdiff_t>(n - column.first - 1, 0, n);
                     i < end; ++i)
                    line[static_cast<std::size_t>(i)] += upper * samples[i + column.first + 1];
            }
        }
        for (std::size_t x = 0; x < film.columns(); ++x) {
            const Resampling::Sample& sample = across.samples[x];
            float sum = 0;
            for (std::size_t k = 0; k < sample.weights.size(); ++k) sum += sample.weights[k] * line[sample.first + k];
            rows(t, x) = sum;
        }
    });
    work::parallel_for(film.rows(), [&](std::size_t y) {
        const Resampling::Sample& sample = down.samples[y];
        float* out = &radiance(y, 0);
        std::fill_n(out, film.columns(), 0.0f);
        for (std::size_t k = 0; k < sample.weights.size(); ++k)
            for (std::size_t x = 0; x < film.columns(); ++x) out[x] += sample.weights[k] * rows(sample.first + k, x);
    });
}

}  // namespace hogel::patterns
