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

PictureQuery front_view(const LightFieldGrid& grid) {
    PictureQuery query;
    query.camera.resolution = {128, 0};
    query.camera.eye.x = -grid.center_u() * query.camera.eye.z;
    query.camera.eye.y = -grid.center_v() * query.camera.eye.z;
    return query;
}

// Returns the sum of squared Laplacians over pixels and channels.
double contrast(const Image& image) {
    double sum = 0;
    for (std::size_t y = 1; y + 1 < image.height(); ++y)
        for (std::size_t x = 1; x + 1 < image.width(); ++x)
            for (std::size_t c = 0; c < image.channels(); ++c) {
                const auto& p = image.pixels;
                const double laplacian =
                    4.0 * p(y, x, c) - p(y, x - 1, c) - p(y, x + 1, c) - p(y - 1, x, c) - p(y + 1, x, c);
                sum += laplacian * laplacian;
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
    const std::lock_guard lock(mutex_);
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
    const std::lock_guard lock(mutex_);
    if (const auto bytes = bytes_of_hogels_.elements(); !bytes.empty()) {
        const auto [fewest, most] = std::ranges::minmax(bytes);
        facts["hogel_bytes"] = {fewest, most};
    }
    return facts;
}

Image LightFieldViewable::photograph_rays(Rays& rays, const PictureQuery& query, const Progress& progress) {
    const std::lock_guard lock(rays.mutex);
    return rays.photographer.photograph(camera(query), {.pupil_samples = query.pupil_samples}, progress);
}

Image LightFieldViewable::by_rays(const PictureQuery& query, const Progress& progress) {
    const bool error = query.by == PictureMethod::error;
    if (query.by != PictureMethod::original && !error) return photograph_rays(*rays_, query, progress);
    // Only the worker of rays calls this, hence no lock.
    if (!original_->rays)
        original_->rays =
            std::make_unique<Rays>(every_nth_hogel(original_->light_field, step_that_fits(grid(), original_->memory)),
                                   original_->memory, progress);
    Image original = photograph_rays(*original_->rays, query, progress);
    return error ? difference(photograph_rays(*rays_, query, progress), original) : original;
}

void LightFieldViewable::by_waves(const PictureQuery& query, std::size_t looks, const OnLooks& shown,
                                  const Progress& progress) {
    waves_->photograph(camera(query), looks, query.preview, shown, progress);
}

Reading LightFieldViewable::read(const PictureQuery& query, const PickPoint& point) const {
    if (query.eyes > 0 || query.by == PictureMethod::side)
        return std::apply(
            [&](const PictureQuery& single, const PickPoint& single_point) { return read(single, single_point); },
            single_picture(query, point));
    const Camera camera = this->camera(query);
    Reading reading = ray_at(camera, point);
    const double U = (reading.x - camera.eye.x) / camera.eye.z, V = (reading.y - camera.eye.y) / camera.eye.z;
    const LightFieldGrid& grid = this->grid();
    const double i = std::round(reading.x / grid.pitch + 0.5 * static_cast<double>(grid.hogels_s) - 0.5);
    const double j = std::round(0.5 * static_cast<double>(grid.hogels_t) - 0.5 - reading.y / grid.pitch);
    // Columns of frequency grids are sines of directions, not tangents.
    if (grid.has_frequencies() || i < 0 || j < 0 || i >= static_cast<double>(grid.hogels_s) ||
        j >= static_cast<double>(grid.hogels_t))
        return reading;
    const LightFieldGrid hogel_grid = grid.of_hogel(i, j);
    const double k = std::round(hogel_grid.column(U)), l = std::round(hogel_grid.row(V));
    if (k < 0 || l < 0 || k >= static_cast<double>(hogel_grid.directions_u) ||
        l >= static_cast<double>(hogel_grid.directions_v))
        return reading;
    LightFieldTile tile(grid, {static_cast<std::size_t>(i), static_cast<std::size_t>(j), 1, 1},
                        light_field_.has_depth());
    light_field_.front().read(tile);
    const auto u = static_cast<std::size_t>(k), v = static_cast<std::size_t>(l);
    reading.inside = true;
    {
        const std::lock_guard lock(mutex_);
        if (bytes_of_hogels_.size() > 0)
            reading.bytes = bytes_of_hogels_(static_cast<std::size_t>(j), static_cast<std::size_t>(i));
    }
    for (std::size_t c = 0; c < 3; ++c) reading.radiance[c] = tile.radiance(std::min(c, grid.channels - 1), 0, 0, v, u);
    if (tile.depth.size() > 0 && std::isfinite(tile.depth(0, 0, v, u))) reading.depth = tile.depth(0, 0, v, u);
    return reading;
}

double LightFieldViewable::focus(const PictureQuery& query, const PickPoint& point, const Progress& progress) {
    if (query.eyes > 0 || query.by == PictureMethod::side)
        return std::apply([&](const PictureQuery& single,
                              const PickPoint& single_point) { return focus(single, single_point, progress); },
                          single_picture(query, point));
    if (light_field_.has_depth()) {
        // At an edge of an object the ray may miss it: try the neighbouring rays.
        std::optional<double> nearest;
        for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {-0.01, 0.0}, {0.01, 0.0}, {0.0, -0.01}, {0.0, 0.01}}) {
            if (nearest) break;
            nearest = read(query, {std::clamp(point.x + dx, 0.0, 1.0), std::clamp(point.y + dy, 0.0, 1.0)}).depth;
        }
        if (nearest && *nearest > -0.95 * query.camera.eye.z) return *nearest;
    }
    return sharpest(query, point, progress);
}

double LightFieldViewable::sharpest(const PictureQuery& query, const PickPoint& point, const Progress& progress) {
    constexpr int pixels = 25, planes = 21;
    const Camera full_camera = camera(query);
    Camera patch = full_camera;
    // A narrow pupil has too much depth of field.
    patch.pupil = std::max(full_camera.pupil, 0.02 * full_camera.eye.z);
    std::tie(patch.picture.center_x, patch.picture.center_y) = point_at(full_camera, point);
    patch.picture.width = patch.picture.height = pixels;
    patch.picture.pitch_x = patch.picture.pitch_y = std::max(full_camera.picture.pitch_x, 0.5 * shown().pitch);
    // A light field is sharp up to depths of a few times pitch/step: [K] 2.3.
    const std::lock_guard lock(rays_->mutex);
    double half_range = 6 * grid().pitch / std::max(grid().step_u(), 1e-9), best_depth = 0, best_contrast = -1;
    for (int round = 0; round < 2; ++round) {
        const double center = best_depth;
        for (int i = 0; i < planes; ++i) {
            const double depth = center + half_range * (2.0 * i / (planes - 1) - 1);
            if (!(depth > -0.9 * full_camera.eye.z)) continue;
            patch.focus_depth = depth;
            const double value = contrast(rays_->photographer.photograph(patch, {.pupil_samples = 32}, progress));
            if (value > best_contrast) {
                best_contrast = value;
                best_depth = depth;
            }
        }
        half_range *= 2.0 / (planes - 1);
    }
    return best_depth;
}

}  // namespace hogel::view
