// SPDX-License-Identifier: Apache-2.0
// What a light field consists of: one hogel, epipolar planes, views, depth.
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

// Each pixel n times as wide and high, so that few of them are seen on a screen.
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

struct Place {
    std::size_t s, t, u, v;
};

// The sample nearest to a ray, or the outermost one towards it.
Place nearest(const LightFieldGrid& grid, const Reading& ray, double U, double V) {
    const auto within = [](double at, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(std::round(at), 0.0, static_cast<double>(count - 1)));
    };
    const double i = ray.x / grid.pitch + 0.5 * static_cast<double>(grid.hogels_s) - 0.5;
    const double j = 0.5 * static_cast<double>(grid.hogels_t) - 0.5 - ray.y / grid.pitch;
    const Place place{within(i, grid.hogels_s), within(j, grid.hogels_t), 0, 0};
    const LightFieldGrid own = grid.of_hogel(static_cast<double>(place.s), static_cast<double>(place.t));
    return {place.s, place.t, within(own.column(U), grid.directions_u), within(own.row(V), grid.directions_v)};
}

Image one_hogel(const LightField& light_field, const Place& at) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {at.s, at.t, 1, 1}, false);
    light_field.front().read(tile);
    Image picture(grid.directions_u, grid.directions_v, grid.channels);
    for (std::size_t v = 0; v < grid.directions_v; ++v)
        for (std::size_t u = 0; u < grid.directions_u; ++u)
            for (std::size_t c = 0; c < grid.channels; ++c) picture.pixels(v, u, c) = tile.radiance(c, 0, 0, v, u);
    return picture;
}

// (s, U): a row of hogels to the right, the directions of one row of each of them down, the rightmost below.
Image across(const LightField& light_field, const Place& at) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {0, at.t, grid.hogels_s, 1}, false);
    light_field.front().read(tile);
    Image picture(grid.hogels_s, grid.directions_u, grid.channels);
    for (std::size_t s = 0; s < grid.hogels_s; ++s)
        for (std::size_t u = 0; u < grid.directions_u; ++u)
            for (std::size_t c = 0; c < grid.channels; ++c) picture.pixels(u, s, c) = tile.radiance(c, 0, s, at.v, u);
    return picture;
}

// (t, V): a column of hogels down, the directions of one column of each of them to the right, the uppermost first.
Image down(const LightField& light_field, const Place& at) {
    const LightFieldGrid& grid = light_field.grid();
    LightFieldTile tile(grid, {at.s, 0, 1, grid.hogels_t}, false);
    light_field.front().read(tile);
    Image picture(grid.directions_v, grid.hogels_t, grid.channels);
    for (std::size_t t = 0; t < grid.hogels_t; ++t)
        for (std::size_t v = 0; v < grid.directions_v; ++v)
            for (std::size_t c = 0; c < grid.channels; ++c) picture.pixels(t, v, c) = tile.radiance(c, t, 0, v, at.u);
    return picture;
}

// What rows of pixels of the eye's picture see, some of all hogels: the inverse of depths between black, what is
// farthest or nothing, and white.
Image depths(const LightField& light_field, const Camera& camera, std::size_t side, const Progress& progress) {
    const LightFieldGrid& grid = light_field.grid();
    const double aspect = grid.height() / grid.width();
    const auto columns = std::max<std::size_t>(1, std::min(side, grid.hogels_s));
    const auto rows = std::clamp<std::size_t>(static_cast<std::size_t>(static_cast<double>(columns) * aspect), 1,
                                              std::max<std::size_t>(1, std::min(side, grid.hogels_t)));
    Image picture(columns, rows, 1);
    float least = std::numeric_limits<float>::infinity(), greatest = -least;
    for (std::size_t y = 0; y < rows; ++y) {
        const std::size_t t = (2 * y + 1) * grid.hogels_t / (2 * rows);
        LightFieldTile tile(grid, {0, t, grid.hogels_s, 1}, true);
        light_field.front().read(tile);
        for (std::size_t x = 0; x < columns; ++x) {
            const std::size_t s = (2 * x + 1) * grid.hogels_s / (2 * columns);
            const double i = static_cast<double>(s), j = static_cast<double>(t);
            const LightFieldGrid own = grid.of_hogel(i, j);
            const double u = std::round(own.column((grid.s(i) - camera.eye.x) / camera.eye.z));
            const double v = std::round(own.row((grid.t(j) - camera.eye.y) / camera.eye.z));
            float depth = std::numeric_limits<float>::infinity();
            if (u >= 0 && v >= 0 && u < static_cast<double>(grid.directions_u) &&
                v < static_cast<double>(grid.directions_v))
                depth = tile.depth(0, s, static_cast<std::size_t>(v), static_cast<std::size_t>(u));
            picture.pixels(y, x, 0) = depth;
            if (!std::isfinite(depth)) continue;
            least = std::min(least, depth);
            greatest = std::max(greatest, depth);
        }
        progress.report(static_cast<double>(y + 1) / static_cast<double>(rows));
    }
    const float range = std::max(greatest - least, 1e-9f);
    for (float& value : picture.pixels.elements())
        value = std::isfinite(value) ? srgb_decode(1 - 0.85f * (value - least) / range) : 0;
    return picture;
}

// The share of a hogel's rays that meet something: of those with a depth, or else of those that are not black.
double coverage_of(const LightFieldTile& tile, std::size_t s, const LightFieldGrid& grid) {
    std::size_t met = 0;
    for (std::size_t v = 0; v < grid.directions_v; ++v)
        for (std::size_t u = 0; u < grid.directions_u; ++u) {
            bool meets = tile.depth.size() > 0 && std::isfinite(tile.depth(0, s, v, u));
            for (std::size_t c = 0; tile.depth.size() == 0 && c < grid.channels; ++c)
                meets = meets || tile.radiance(c, 0, s, v, u) > 0;
            met += meets;
        }
    return static_cast<double>(met) / static_cast<double>(grid.directions());
}

// Looks at up to `side` rows of hogels, and at as many hogels of each.
Image coverage(const LightField& light_field, std::size_t side, const Progress& progress) {
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
    const std::lock_guard lock(measured_);
    if (bytes_of_hogels_.size() == 0)
        throw Error(ErrorCode::usage, "what=rate: the bytes of hogels are not known; of a .hgl file they are");
    const auto [fewest, most] = std::ranges::minmax(bytes_of_hogels_.elements());
    return heat_map(bytes_of_hogels_, fewest, most);
}

// The pictures that eyes far away see, each of one direction: rays of all hogels, interpolated.
Image LightFieldViewable::views(const Inside& inside, const Progress& progress) {
    const LightFieldGrid& grid = this->grid();
    const auto columns = std::min<std::size_t>(7, grid.directions_u),
               rows = std::min<std::size_t>(7, grid.directions_v);
    const std::size_t width = std::max<std::size_t>(1, inside.side / columns - 1);
    View one = {};
    one.camera.resolution = {width, 0};
    one.pupil_samples = 1;
    constexpr double far = 1e3;  // metres: farther than what directions differ by from hogel to hogel can tell
    one.camera.eye.z = far;
    one.camera.pupil = 1e-6;
    Image all;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const auto middle = [](std::size_t index, std::size_t count, std::size_t samples) {
                return (static_cast<double>(index) + 0.5) * static_cast<double>(samples) / static_cast<double>(count) -
                       0.5;
            };
            one.camera.eye.x = -far * grid.u(middle(column, columns, grid.directions_u));
            one.camera.eye.y = -far * grid.v(middle(row, rows, grid.directions_v));
            const Image view = by_rays(one, progress);
            if (all.pixels.size() == 0)
                all = Image(columns * (view.width() + 1), rows * (view.height() + 1), view.channels());
            for (std::size_t y = 0; y < view.height(); ++y)
                std::ranges::copy(view.pixels[y].elements(),
                                  &all.pixels(row * (view.height() + 1) + y, column * (view.width() + 1), 0));
            progress.report(0);
        }
    return all;
}

Photograph LightFieldViewable::inside(const View& view, const PickPoint& point, const Inside& inside,
                                      const Progress& progress) {
    if (view.eyes > 0 || view.by == By::side) {
        const auto [one, at] = in_one_picture(view, point);
        return this->inside(one, at, inside, progress);
    }
    const Camera camera = this->camera(view);
    const Reading ray = ray_at(camera, point);
    const auto place = [&] {
        return nearest(grid(), ray, (ray.x - camera.eye.x) / camera.eye.z, (ray.y - camera.eye.y) / camera.eye.z);
    };
    const double exposure = view.exposure > 0 ? view.exposure : exposure_;
    if (inside.what == "hogel") return {enlarged_to(one_hogel(light_field_, place()), inside.side), exposure, 0, {}};
    if (inside.what == "s-u") return {across(light_field_, place()), exposure, 0, {}};
    if (inside.what == "t-v") return {down(light_field_, place()), exposure, 0, {}};
    if (inside.what == "views") return {views(inside, progress), exposure, 0, {}};
    if (inside.what == "depth") {
        if (!light_field_.has_depth())
            throw Error(ErrorCode::usage, "what=depth: the light field has no depth; 'hogel render --depth' stores it");
        return {depths(light_field_, camera, inside.side, progress), 1, 0, {}};
    }
    if (inside.what == "coverage") {
        constexpr std::size_t max_rows = 128;  // of hogels, each of which is read
        return {enlarged_to(coverage(light_field_, std::min(inside.side, max_rows), progress), inside.side), 1, 0, {}};
    }
    if (inside.what == "rate") return {enlarged_to(rates(), inside.side), 1, 0, {}};
    throw Error(ErrorCode::usage,
                fmt::format("what: '{}' is not hogel, views, s-u, t-v, depth, coverage or rate", inside.what));
}

}  // namespace hogel::view
