// SPDX-License-Identifier: Apache-2.0
// Pictures of the data of a light field: one hogel, epipolar planes, views, depth, coverage, rate.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hogel/error.h"
#include "view/heat.h"
#include "view/light_field_viewable.h"

namespace hogel::view {
namespace {

// Enlarges a small picture by pixel replication.
Image enlarged(const Image& picture, std::size_t n) {
    Image large(n * picture.width(), n * picture.height(), picture.channels());
    for (std::size_t y = 0; y < large.height(); ++y)
        for (std::size_t x = 0; x < large.width(); ++x)
            for (std::size_t c = 0; c < large.channels(); ++c) large.pixels(y, x, c) = picture.pixels(y / n, x / n, c);
    return large;
}

Image enlarged_to(const Image& picture, std::size_t side) {
    const std::size_t n = side / std::max<std::size_t>(1, std::max(picture.width(), picture.height()));
    return n > 1 ? enlarged(picture, n) : picture;
}

struct SampleIndex {
    std::size_t s, t, u, v;
};

// Returns the index of the sample nearest to a ray, clamped to the grid.
SampleIndex nearest_sample(const LightFieldGrid& grid, const Reading& ray, double U, double V) {
    const auto clamped = [](double position, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(std::round(position), 0.0, static_cast<double>(count - 1)));
    };
    const double i = ray.x / grid.pitch + 0.5 * static_cast<double>(grid.hogels_s) - 0.5;
    const double j = 0.5 * static_cast<double>(grid.hogels_t) - 0.5 - ray.y / grid.pitch;
    const SampleIndex index{clamped(i, grid.hogels_s), clamped(j, grid.hogels_t), 0, 0};
    const LightFieldGrid hogel_grid = grid.of_hogel(static_cast<double>(index.s), static_cast<double>(index.t));
    return {index.s, index.t, clamped(hogel_grid.column(U), grid.directions_u),
            clamped(hogel_grid.row(V), grid.directions_v)};
}

Image hogel_image(const LightField& light_field, const SampleIndex& index) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {index.s, index.t, 1, 1}, false);
    light_field.front().read(tile);
    Image picture(grid.directions_u, grid.directions_v, grid.channels);
    for (std::size_t v = 0; v < grid.directions_v; ++v)
        for (std::size_t u = 0; u < grid.directions_u; ++u)
            for (std::size_t c = 0; c < grid.channels; ++c) picture.pixels(v, u, c) = tile.radiance(c, 0, 0, v, u);
    return picture;
}

// Epipolar plane image (s, U): a row of hogels to the right, one row of directions of each downwards.
Image epi_s_u(const LightField& light_field, const SampleIndex& index) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {0, index.t, grid.hogels_s, 1}, false);
    light_field.front().read(tile);
    Image picture(grid.hogels_s, grid.directions_u, grid.channels);
    for (std::size_t s = 0; s < grid.hogels_s; ++s)
        for (std::size_t u = 0; u < grid.directions_u; ++u)
            for (std::size_t c = 0; c < grid.channels; ++c)
                picture.pixels(u, s, c) = tile.radiance(c, 0, s, index.v, u);
    return picture;
}

// Epipolar plane image (t, V): a column of hogels downwards, one column of directions of each to the right, the
// uppermost direction first.
Image epi_t_v(const LightField& light_field, const SampleIndex& index) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {index.s, 0, 1, grid.hogels_t}, false);
    light_field.front().read(tile);
    Image picture(grid.directions_v, grid.hogels_t, grid.channels);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (std::size_t c = 0; c < grid.channels; ++c)
                picture.pixels(t, v, c) = tile.radiance(c, t, 0, v, index.u);
    return picture;
}

// Returns the depths seen from the viewpoint through a subset of the hogels: near is bright, rays without depth are
// black.
Image depth_image(const LightField& light_field, const Camera& camera, std::size_t side, const Progress& progress) {
    const LightFieldGrid& grid = light_field.grid();
    const double aspect = grid.height() / grid.width();
    const auto columns = std::max<std::size_t>(1, std::min(side, grid.hogels_s));
    const auto rows = std::clamp<std::size_t>(static_cast<std::size_t>(static_cast<double>(columns) * aspect), 1,
                                              std::max<std::size_t>(1, std::min(side, grid.hogels_t)));
    Image picture(columns, rows, 1);
    float nearest_depth = std::numeric_limits<float>::infinity(), farthest_depth = -nearest_depth;
    for (std::size_t y = 0; y < rows; ++y) {
        const std::size_t t = (2 * y + 1) * grid.hogels_t / (2 * rows);
        LightFieldTile tile(grid, {0, t, grid.hogels_s, 1}, true);
        light_field.front().read(tile);
        for (std::size_t x = 0; x < columns; ++x) {
            const std::size_t s = (2 * x + 1) * grid.hogels_s / (2 * columns);
            const double i = static_cast<double>(s), j = static_cast<double>(t);
            const LightFieldGrid hogel_grid = grid.of_hogel(i, j);
            const double u = std::round(hogel_grid.column((grid.s(i) - camera.eye.x) / camera.eye.z));
            const double v = std::round(hogel_grid.row((grid.t(j) - camera.eye.y) / camera.eye.z));
            float depth = std::numeric_limits<float>::infinity();
            if (u >= 0 && v >= 0 && u < static_cast<double>(grid.directions_u) &&
                v < static_cast<double>(grid.directions_v))
                depth = tile.depth(0, s, static_cast<std::size_t>(v), static_cast<std::size_t>(u));
            picture.pixels(y, x, 0) = depth;
            if (!std::isfinite(depth)) continue;
            nearest_depth = std::min(nearest_depth, depth);
            farthest_depth = std::max(farthest_depth, depth);
        }
        progress.report(static_cast<double>(y + 1) / static_cast<double>(rows));
    }
    const float range = std::max(farthest_depth - nearest_depth, 1e-9f);
    for (float& value : picture.pixels.elements())
        value = std::isfinite(value) ? srgb_decode(1 - 0.85f * (value - nearest_depth) / range) : 0;
    return picture;
}

// Returns the fraction of a hogel's rays that have a depth, or without depth that are not black.
double coverage_of(const LightFieldTile& tile, std::size_t s, const LightFieldGrid& grid) {
    std::size_t hits = 0;
    for (std::size_t v = 0; v < grid.directions_v; ++v)
        for (std::size_t u = 0; u < grid.directions_u; ++u) {
            bool hit = tile.depth.size() > 0 && std::isfinite(tile.depth(0, s, v, u));
            for (std::size_t c = 0; tile.depth.size() == 0 && c < grid.channels; ++c)
                hit = hit || tile.radiance(c, 0, s, v, u) > 0;
            hits += hit;
        }
    return static_cast<double>(hits) / static_cast<double>(grid.directions());
}

// Samples at most `side` × `side` hogels.
Image coverage_image(const LightField& light_field, std::size_t side, const Progress& progress) {
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t columns = std::min(side, grid.hogels_s), rows = std::min(side, grid.hogels_t);
    Array<double, 2> shares(Shape<2>{rows, columns});
    for (std::size_t y = 0; y < rows; ++y) {
        LightFieldTile tile(grid, {0, (2 * y + 1) * grid.hogels_t / (2 * rows), grid.hogels_s, 1},
                            light_field.has_depth());
        light_field.front().read(tile);
        for (std::size_t x = 0; x < columns; ++x)
            shares(y, x) = coverage_of(tile, (2 * x + 1) * grid.hogels_s / (2 * columns), grid);
        progress.report(static_cast<double>(y + 1) / static_cast<double>(rows));
    }
    return heat_map(shares, 0, 1);
}

}  // namespace

Image LightFieldViewable::rates() const {
    const std::lock_guard lock(mutex_);
    if (bytes_of_hogels_.size() == 0)
        throw Error(ErrorCode::usage,
                    "what=rate: the bytes per hogel are not known; open a compressed light field (.hgl)");
    const auto [fewest, most] = std::ranges::minmax(bytes_of_hogels_.elements());
    return heat_map(bytes_of_hogels_, fewest, most);
}

// Photographs from viewpoints at a large distance: each shows one direction of all hogels.
Image LightFieldViewable::views(const InsideQuery& inside, const Progress& progress) {
    const LightFieldGrid& grid = this->grid();
    const auto columns = std::min<std::size_t>(7, grid.directions_u),
               rows = std::min<std::size_t>(7, grid.directions_v);
    const std::size_t width = std::max<std::size_t>(1, inside.side / columns - 1);
    PictureQuery query = {};
    query.camera.resolution = {width, 0};
    query.pupil_samples = 1;
    constexpr double distance = 1e3;  // metres; directions of different hogels coincide within the sampling
    query.camera.eye.z = distance;
    query.camera.pupil = 1e-6;
    Image mosaic;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const auto middle = [](std::size_t index, std::size_t count, std::size_t samples) {
                return (static_cast<double>(index) + 0.5) * static_cast<double>(samples) / static_cast<double>(count) -
                       0.5;
            };
            query.camera.eye.x = -distance * grid.u(middle(column, columns, grid.directions_u));
            query.camera.eye.y = -distance * grid.v(middle(row, rows, grid.directions_v));
            const Image picture = by_rays(query, progress);
            if (mosaic.pixels.size() == 0)
                mosaic = Image(columns * (picture.width() + 1), rows * (picture.height() + 1), picture.channels());
            for (std::size_t y = 0; y < picture.height(); ++y)
                std::ranges::copy(picture.pixels[y].elements(),
                                  &mosaic.pixels(row * (picture.height() + 1) + y, column * (picture.width() + 1), 0));
            progress.report(0);
        }
    return mosaic;
}

Photograph LightFieldViewable::inside(const PictureQuery& query, const PickPoint& point, const InsideQuery& inside,
                                      const Progress& progress) {
    if (query.eyes > 0 || query.by == PictureMethod::side) {
        const auto [single, single_point] = single_picture(query, point);
        return this->inside(single, single_point, inside, progress);
    }
    const Camera camera = this->camera(query);
    const Reading ray = ray_at(camera, point);
    const auto index = [&] {
        return nearest_sample(grid(), ray, (ray.x - camera.eye.x) / camera.eye.z,
                              (ray.y - camera.eye.y) / camera.eye.z);
    };
    const double exposure = query.exposure > 0 ? query.exposure : exposure_;
    if (inside.what == "hogel") return {enlarged_to(hogel_image(light_field_, index()), inside.side), exposure, 0, {}};
    if (inside.what == "s-u") return {epi_s_u(light_field_, index()), exposure, 0, {}};
    if (inside.what == "t-v") return {epi_t_v(light_field_, index()), exposure, 0, {}};
    if (inside.what == "views") return {views(inside, progress), exposure, 0, {}};
    if (inside.what == "depth") {
        if (!light_field_.has_depth())
            throw Error(ErrorCode::usage, "what=depth: the light field has no depth; 'hogel render --depth' stores it");
        return {depth_image(light_field_, camera, inside.side, progress), 1, 0, {}};
    }
    if (inside.what == "coverage") {
        constexpr std::size_t max_rows = 128;  // each hogel is read
        return {enlarged_to(coverage_image(light_field_, std::min(inside.side, max_rows), progress), inside.side),
                1,
                0,
                {}};
    }
    if (inside.what == "rate") return {enlarged_to(rates(), inside.side), 1, 0, {}};
    throw Error(ErrorCode::usage,
                fmt::format("what: '{}' is not hogel, views, s-u, t-v, depth, coverage or rate", inside.what));
}

}  // namespace hogel::view
