// SPDX-License-Identifier: Apache-2.0
#include "view/light_field_viewable.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace hogel::view {
namespace {

View front_view(const LightFieldGrid& grid) {
    View view;
    view.camera.resolution = {128, 0};
    view.camera.eye.x = -grid.center_u() * view.camera.eye.z;
    view.camera.eye.y = -grid.center_v() * view.camera.eye.z;
    return view;
}

// The contrast of a few pixels: the mean square of their second differences, over all channels.
double contrast(const Image& image) {
    double sum = 0;
    for (std::size_t y = 1; y + 1 < image.height(); ++y)
        for (std::size_t x = 1; x + 1 < image.width(); ++x)
            for (std::size_t c = 0; c < image.channels(); ++c) {
                const auto& p = image.pixels;
                const double bend =
                    4.0 * p(y, x, c) - p(y, x - 1, c) - p(y, x + 1, c) - p(y - 1, x, c) - p(y + 1, x, c);
                sum += bend * bend;
            }
    return sum;
}

}  // namespace

std::size_t step_for(const LightFieldGrid& grid, double samples) {
    const double step = std::sqrt(grid.samples() / samples);
    if (step <= 1) return 1;
    const auto n = static_cast<std::size_t>(std::ceil(step));
    return n % 2 == 1 ? n : n + 1;
}

std::size_t step_that_fits(const LightFieldGrid& grid, std::size_t memory) {
    return step_for(grid, static_cast<double>(memory) / 2);
}

std::size_t step_of_first_look(const LightFieldGrid& grid) { return step_for(grid, first_look_samples); }

LightFieldViewable::LightFieldViewable(LightField light_field, LightField shown, std::size_t memory,
                                       const Progress& progress, std::unique_ptr<Waves> waves)
    : light_field_(std::move(light_field)),
      rays_(std::make_shared<Rays>(std::move(shown), memory, progress)),
      waves_(std::move(waves)),
      memory_(memory) {
    exposure_ =
        automatic_exposure(rays_->photographer.photograph(camera(front_view(grid())), {.pupil_samples = 4}, progress));
}

LightFieldViewable::LightFieldViewable(const LightFieldViewable& other, std::unique_ptr<Waves> waves)
    : light_field_(other.light_field_),
      rays_(other.rays_),
      waves_(std::move(waves)),
      exposure_(other.exposure_),
      memory_(other.memory_) {}

void LightFieldViewable::set_original(LightField original) {
    original_ = std::make_unique<Original>(Original{std::move(original), memory_, {}});
}

void LightFieldViewable::set_bytes_of_hogels(Array<double, 2> bytes) {
    const std::lock_guard lock(measured_);
    bytes_of_hogels_ = std::move(bytes);
}

nlohmann::ordered_json LightFieldViewable::facts() const {
    const LightFieldGrid& grid = this->grid();
    nlohmann::ordered_json facts{{"kind", "light field"},
                                 {"hogels_s", grid.hogels_s},
                                 {"hogels_t", grid.hogels_t},
                                 {"shown_hogels_s", shown().hogels_s},
                                 {"directions_u", grid.directions_u},
                                 {"directions_v", grid.directions_v},
                                 {"tan_half_u", grid.half_u()},
                                 {"tan_half_v", grid.half_v()},
                                 {"center_u", grid.center_u()},
                                 {"center_v", grid.center_v()},
                                 {"channels", grid.channels},
                                 {"depth", light_field_.has_depth()}};
    const std::lock_guard lock(measured_);
    if (const auto bytes = bytes_of_hogels_.elements(); !bytes.empty()) {
        const auto [fewest, most] = std::ranges::minmax(bytes);
        facts["hogel_bytes"] = {fewest, most};
    }
    return facts;
}

Image LightFieldViewable::photograph_rays(Rays& rays, const View& view, const Progress& progress) {
    const std::lock_guard lock(rays.photographing);
    return rays.photographer.photograph(camera(view), {.pupil_samples = view.pupil_samples}, progress);
}

Image LightFieldViewable::by_rays(const View& view, const Progress& progress) {
    const bool error = view.by == By::error;
    if (view.by != By::original && !error) return photograph_rays(*rays_, view, progress);
    // One thread photographs by rays, so that nothing else looks at this.
    if (!original_->rays)
        original_->rays =
            std::make_unique<Rays>(every_nth_hogel(original_->light_field, step_that_fits(grid(), original_->memory)),
                                   original_->memory, progress);
    Image original = photograph_rays(*original_->rays, view, progress);
    return error ? difference(photograph_rays(*rays_, view, progress), original) : original;
}

void LightFieldViewable::by_waves(const View& view, std::size_t looks, const OnLooks& shown, const Progress& progress) {
    waves_->photograph(camera(view), looks, view.preview, shown, progress);
}

Reading LightFieldViewable::read(const View& view, const PickPoint& point) const {
    if (view.eyes > 0 || view.by == By::side)
        return std::apply([&](const View& one, const PickPoint& at) { return read(one, at); },
                          in_one_picture(view, point));
    const Camera camera = this->camera(view);
    Reading reading = ray_at(camera, point);
    const double U = (reading.x - camera.eye.x) / camera.eye.z, V = (reading.y - camera.eye.y) / camera.eye.z;
    const LightFieldGrid& grid = this->grid();
    const double i = std::round(reading.x / grid.pitch + 0.5 * static_cast<double>(grid.hogels_s) - 0.5);
    const double j = std::round(0.5 * static_cast<double>(grid.hogels_t) - 0.5 - reading.y / grid.pitch);
    // Not where directions are sines, whose columns are not at U.
    if (grid.has_frequencies() || i < 0 || j < 0 || i >= static_cast<double>(grid.hogels_s) ||
        j >= static_cast<double>(grid.hogels_t))
        return reading;
    const LightFieldGrid own = grid.of_hogel(i, j);
    const double k = std::round(own.column(U)), l = std::round(own.row(V));
    if (k < 0 || l < 0 || k >= static_cast<double>(own.directions_u) || l >= static_cast<double>(own.directions_v))
        return reading;
    LightFieldTile tile(grid, {static_cast<std::size_t>(i), static_cast<std::size_t>(j), 1, 1},
                        light_field_.has_depth());
    light_field_.front().read(tile);
    const auto u = static_cast<std::size_t>(k), v = static_cast<std::size_t>(l);
    reading.inside = true;
    {
        const std::lock_guard lock(measured_);
        if (bytes_of_hogels_.size() > 0)
            reading.bytes = bytes_of_hogels_(static_cast<std::size_t>(j), static_cast<std::size_t>(i));
    }
    for (std::size_t c = 0; c < 3; ++c) reading.radiance[c] = tile.radiance(std::min(c, grid.channels - 1), 0, 0, v, u);
    if (tile.depth.size() > 0 && std::isfinite(tile.depth(0, 0, v, u))) reading.depth = tile.depth(0, 0, v, u);
    return reading;
}

double LightFieldViewable::focus(const View& view, const PickPoint& point, const Progress& progress) {
    if (view.eyes > 0 || view.by == By::side)
        return std::apply([&](const View& one, const PickPoint& at) { return focus(one, at, progress); },
                          in_one_picture(view, point));
    if (light_field_.has_depth()) {
        // Beside an object's edge the ray may pass it: the nearest of the rays around it decides.
        std::optional<double> nearest;
        for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {-0.01, 0.0}, {0.01, 0.0}, {0.0, -0.01}, {0.0, 0.01}}) {
            if (nearest) break;
            nearest = read(view, {std::clamp(point.x + dx, 0.0, 1.0), std::clamp(point.y + dy, 0.0, 1.0)}).depth;
        }
        if (nearest && *nearest > -0.95 * view.camera.eye.z) return *nearest;
    }
    return sharpest(view, point, progress);
}

double LightFieldViewable::sharpest(const View& view, const PickPoint& point, const Progress& progress) {
    constexpr int pixels = 25, planes = 21;
    const Camera whole = camera(view);
    Camera patch = whole;
    // A narrow pupil has everything in focus.
    patch.pupil = std::max(whole.pupil, 0.02 * whole.eye.z);
    std::tie(patch.picture.center_x, patch.picture.center_y) = point_at(whole, point);
    patch.picture.width = patch.picture.height = pixels;
    patch.picture.pitch_x = patch.picture.pitch_y = std::max(whole.picture.pitch_x, 0.5 * shown().pitch);
    // A light field shows depths of up to a few times pitch/step sharply: [K] 2.3.
    const std::lock_guard lock(rays_->photographing);
    double reach = 6 * grid().pitch / std::max(grid().step_u(), 1e-9), middle = 0, best = -1;
    for (int round = 0; round < 2; ++round) {
        const double around = middle;
        for (int i = 0; i < planes; ++i) {
            const double depth = around + reach * (2.0 * i / (planes - 1) - 1);
            if (!(depth > -0.9 * whole.eye.z)) continue;
            patch.focus_depth = depth;
            const double value = contrast(rays_->photographer.photograph(patch, {.pupil_samples = 32}, progress));
            if (value > best) {
                best = value;
                middle = depth;
            }
        }
        reach *= 2.0 / (planes - 1);
    }
    return middle;
}

}  // namespace hogel::view
