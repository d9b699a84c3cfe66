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

// Both pictures as they are beside each other, shown with one exposure.
Photograph together(const View& view, const Image& rays, const Image& waves, double exposure) {
    Photograph both;
    both.exposure = exposure;
    // In motion there is no time for it.
    if (!view.moving && rays.channels() == waves.channels()) both.psnr = compare(waves, rays, exposure).psnr;
    if (view.by == By::difference) {
        both.picture = view.logarithmic ? logarithmic(difference(rays, waves)) : difference(rays, waves);
        return both;
    }
    both.picture = view.logarithmic ? side_by_side(logarithmic(rays), logarithmic(waves)) : side_by_side(rays, waves);
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

std::pair<View, PickPoint> in_one_picture(const View& view, const PickPoint& point) {
    const bool right = point.x >= 0.5;
    const PickPoint inner{std::min(2 * point.x - (right ? 1 : 0), 1.0), point.y};
    if (view.eyes > 0) return {of_eye(view, right ? 1 : -1), inner};
    View one = view;
    one.by = right ? By::waves : By::rays;
    return {one, inner};
}

Image side_by_side(const Image& left, const Image& right) {
    Image both(left.width() + right.width(), left.height(), std::max(left.channels(), right.channels()));
    const auto put = [&](const Image& from, std::size_t first) {
        for (std::size_t y = 0; y < from.height(); ++y)
            for (std::size_t x = 0; x < from.width(); ++x)
                for (std::size_t c = 0; c < both.channels(); ++c)
                    both.pixels(y, first + x, c) = from.pixels(y, x, std::min(c, from.channels() - 1));
    };
    put(left, 0);
    put(right, left.width());
    return both;
}

Camera Viewable::camera(const View& view) const {
    const Camera camera = view.camera.cameras(width(), height()).front();
    if (camera.picture.samples() > max_pixels)
        throw Error(ErrorCode::usage, "resolution",
                    fmt::format("resolution: {}x{} pixels; expected at most {} in all", camera.picture.width,
                                camera.picture.height, max_pixels));
    return camera;
}

void Viewable::require(const View& view) const {
    camera(view);
    if (view.by != By::waves && !has_rays())
        throw Error(ErrorCode::usage, "by", "by: a hologram has no rays to follow; by=waves would do");
    if ((view.by == By::original || view.by == By::error) && !has_original())
        throw Error(ErrorCode::usage, "by", "by: there is no original; a .hgl file has one");
    if (needs_waves(view.by) && looks() == 0)
        throw Error(ErrorCode::usage, "by", "by: there are no waves yet; by=rays would do");
    if ((view.by == By::side || view.by == By::difference) && view.eyes > 0)
        throw Error(ErrorCode::usage, "by, eyes", "by: rays and waves are compared from one eye; leave out eyes");
}

FocusSearch Viewable::find_focus(const Progress&) {
    throw Error(ErrorCode::usage, "the depths of a light field are looked for under the pointer: 'focus?'");
}

LevelCounts Viewable::count_levels(const std::string&, const Progress&) {
    throw Error(ErrorCode::usage, "levels: a light field has none; a hologram has");
}

Photograph Viewable::photograph(const View& view, const Progress& progress) {
    Photograph last;
    photograph(
        view, [&](const Photograph& picture) { last = picture; }, progress);
    return last;
}

void Viewable::photograph(const View& view, const Shown& shown, const Progress& progress) {
    if (view.eyes > 0) return photograph_eyes(view, shown, progress);
    photograph_eye(view, view.looks, shown, progress);
}

void Viewable::photograph_eye(const View& view, std::size_t looks, const Shown& shown, const Progress& progress) {
    const double exposure = view.logarithmic ? 1 : view.exposure > 0 ? view.exposure : this->exposure();
    Image rays;
    if (view.by != By::waves) rays = by_rays(view, progress);
    if (!needs_waves(view.by)) return shown({view.logarithmic ? logarithmic(rays) : std::move(rays), exposure, 0, {}});
    by_waves(
        view, looks,
        [&](const Image& waves, std::size_t so_far) {
            Photograph picture;
            if (view.by == By::waves)
                picture = {view.logarithmic ? logarithmic(waves) : waves, exposure, 0, {}};
            else
                picture = together(view, rays, waves, exposure);
            picture.looks = so_far;
            shown(picture);
        },
        progress);
}

// One eye after the other: of waves first one look of both, then all.
void Viewable::photograph_eyes(const View& view, const Shown& shown, const Progress& progress) {
    const auto both = [&](std::size_t looks) {
        Photograph pictures[2];
        for (const int side : {-1, 1})
            photograph_eye(
                of_eye(view, side), looks, [&](const Photograph& one) { pictures[side > 0] = one; }, progress);
        pictures[0].picture = side_by_side(pictures[0].picture, pictures[1].picture);
        shown(pictures[0]);
    };
    if (view.by == By::waves && view.looks != 1) both(1);
    both(view.looks);
}

}  // namespace hogel::view
