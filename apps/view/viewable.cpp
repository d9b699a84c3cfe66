// SPDX-License-Identifier: Apache-2.0
#include "view/viewable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hogel/error.h"
#include "hogel/pipeline.h"

namespace hogel::view {
namespace {

constexpr std::size_t max_pixels = std::size_t{3840} * 2160;

// Joins or subtracts the pictures by rays and by waves, with a common exposure.
Photograph compare_methods(const PictureQuery& query, const Image& rays, const Image& waves, double exposure) {
    Photograph both;
    both.exposure = exposure;
    // Skipped in motion to save time.
    if (!query.moving && rays.channels() == waves.channels()) both.psnr = compare(waves, rays, exposure).psnr;
    if (query.by == PictureMethod::difference) {
        both.picture = query.logarithmic ? logarithmic(difference(rays, waves)) : difference(rays, waves);
        return both;
    }
    both.picture = query.logarithmic ? side_by_side(logarithmic(rays), logarithmic(waves)) : side_by_side(rays, waves);
    return both;
}

}  // namespace

Image difference(const Image& a, const Image& b) {
    Image result(a.width(), a.height(), std::max(a.channels(), b.channels()));
    for (std::size_t y = 0; y < a.height(); ++y)
        for (std::size_t x = 0; x < a.width(); ++x)
            for (std::size_t c = 0; c < result.channels(); ++c)
                result.pixels(y, x, c) = std::abs(a.pixels(y, x, std::min(c, a.channels() - 1)) -
                                                  b.pixels(y, x, std::min(c, b.channels() - 1)));
    return result;
}

std::pair<double, double> point_at(const Camera& camera, const PickPoint& point) {
    const Grid& picture = camera.picture;
    return {picture.center_x + (point.x - 0.5) * picture.size_x(),
            picture.center_y + (0.5 - point.y) * picture.size_y()};
}

Reading ray_at(const Camera& camera, const PickPoint& point) {
    Reading reading;
    std::tie(reading.x, reading.y) = point_at(camera, point);
    reading.across = std::atan((reading.x - camera.eye.x) / camera.eye.z);
    reading.up = std::atan((reading.y - camera.eye.y) / camera.eye.z);
    return reading;
}

std::pair<PictureQuery, PickPoint> single_picture(const PictureQuery& query, const PickPoint& point) {
    const bool right = point.x >= 0.5;
    const PickPoint inner{std::min(2 * point.x - (right ? 1 : 0), 1.0), point.y};
    if (query.eyes > 0) return {query_of_eye(query, right ? 1 : -1), inner};
    PictureQuery single = query;
    single.by = right ? PictureMethod::waves : PictureMethod::rays;
    return {single, inner};
}

Image side_by_side(const Image& left, const Image& right) {
    Image both(left.width() + right.width(), left.height(), std::max(left.channels(), right.channels()));
    const auto paste = [&](const Image& from, std::size_t first) {
        for (std::size_t y = 0; y < from.height(); ++y)
            for (std::size_t x = 0; x < from.width(); ++x)
                for (std::size_t c = 0; c < both.channels(); ++c)
                    both.pixels(y, first + x, c) = from.pixels(y, x, std::min(c, from.channels() - 1));
    };
    paste(left, 0);
    paste(right, left.width());
    return both;
}

Camera Viewable::camera(const PictureQuery& query) const {
    const Camera camera = query.camera.cameras(width(), height()).front();
    if (camera.picture.samples() > max_pixels)
        throw Error(ErrorCode::usage, "resolution",
                    fmt::format("resolution: {}x{} pixels; expected at most {} in all", camera.picture.width,
                                camera.picture.height, max_pixels));
    return camera;
}

void Viewable::require(const PictureQuery& query) const {
    camera(query);
    if (query.by != PictureMethod::waves && !has_rays())
        throw Error(ErrorCode::usage, "by", "by: a hologram has no rays; use by=waves");
    if ((query.by == PictureMethod::original || query.by == PictureMethod::error) && !has_original())
        throw Error(ErrorCode::usage, "by",
                    "by: there is no original to compare with; open a compressed light field (.hgl)");
    if (needs_waves(query.by) && looks() == 0)
        throw Error(ErrorCode::usage, "by", "by: the holograms are not ready yet; use by=rays");
    if ((query.by == PictureMethod::side || query.by == PictureMethod::difference) && query.eyes > 0)
        throw Error(ErrorCode::usage, "by, eyes", "by: rays and waves are compared from one viewpoint; leave out eyes");
}

FocusSearch Viewable::find_focus(const Progress&) {
    throw Error(ErrorCode::usage,
                "sharpness: only for holograms; use 'focus?' for the depth of a light field at a point");
}

LevelCounts Viewable::count_levels(const std::string&, const Progress&) {
    throw Error(ErrorCode::usage, "levels: only for holograms");
}

Photograph Viewable::photograph(const PictureQuery& query, const Progress& progress) {
    Photograph last;
    photograph(
        query, [&](const Photograph& picture) { last = picture; }, progress);
    return last;
}

void Viewable::photograph(const PictureQuery& query, const Shown& shown, const Progress& progress) {
    if (query.eyes > 0) return photograph_eyes(query, shown, progress);
    photograph_eye(query, query.looks, shown, progress);
}

void Viewable::photograph_eye(const PictureQuery& query, std::size_t looks, const Shown& shown,
                              const Progress& progress) {
    const double exposure = query.logarithmic ? 1 : query.exposure > 0 ? query.exposure : this->exposure();
    Image rays;
    if (query.by != PictureMethod::waves) rays = by_rays(query, progress);
    if (!needs_waves(query.by))
        return shown({query.logarithmic ? logarithmic(rays) : std::move(rays), exposure, 0, {}});
    by_waves(
        query, looks,
        [&](const Image& waves, std::size_t so_far) {
            Photograph picture;
            if (query.by == PictureMethod::waves)
                picture = {query.logarithmic ? logarithmic(waves) : waves, exposure, 0, {}};
            else
                picture = compare_methods(query, rays, waves, exposure);
            picture.looks = so_far;
            shown(picture);
        },
        progress);
}

// Photographs both viewpoints; by waves first one look of each, then all.
void Viewable::photograph_eyes(const PictureQuery& query, const Shown& shown, const Progress& progress) {
    const auto both = [&](std::size_t looks) {
        Photograph pictures[2];
        for (const int side : {-1, 1})
            photograph_eye(
                query_of_eye(query, side), looks, [&](const Photograph& single) { pictures[side > 0] = single; },
                progress);
        pictures[0].picture = side_by_side(pictures[0].picture, pictures[1].picture);
        shown(pictures[0]);
    };
    if (query.by == PictureMethod::waves && query.looks != 1) both(1);
    both(query.looks);
}

}  // namespace hogel::view
