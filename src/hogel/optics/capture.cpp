// SPDX-License-Identifier: Apache-2.0
#include "hogel/optics/capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "hogel/optics/narrow_band/narrow_band.h"
#include "hogel/optics/photograph_plan.h"
#include "hogel/units.h"

namespace hogel::optics {
namespace {

// What the cameras of one eye need: its widest pupil and its farthest focus combined in one camera, which bounds the
// memory, and the widest blur on a film.
struct Eye {
    Camera widest;
    double blur;
};

std::vector<Eye> eyes_of(std::span<const Camera> cameras) {
    std::vector<Eye> eyes;
    for (const Camera& camera : cameras) {
        validate(camera);
        const auto same = std::ranges::find_if(eyes, [&](const Eye& eye) { return eye.widest.eye == camera.eye; });
        if (same == eyes.end()) {
            eyes.push_back({camera, defocus_blur(camera)});
            continue;
        }
        same->widest.pupil = std::max(same->widest.pupil, camera.pupil);
        if (defocus_blur(camera) <= same->blur) continue;
        same->blur = defocus_blur(camera);
        same->widest.focus_depth = camera.focus_depth;
        same->widest.focus_slope_x = camera.focus_slope_x;
        same->widest.focus_slope_y = camera.focus_slope_y;
        same->widest.picture = camera.picture;
    }
    return eyes;
}

}  // namespace

Image CapturedEye::photograph(const Camera& camera) const {
    validate(camera);
    constexpr double rounding = 1 + 1e-9;
    if (!(camera.eye == eye_))
        throw Error(ErrorCode::usage, fmt::format("light was captured at the eye ({}, {}, {}) m, not at ({}, {}, {}) m",
                                                  eye_.x, eye_.y, eye_.z, camera.eye.x, camera.eye.y, camera.eye.z));
    if (camera.pupil > pupil_ * rounding)
        throw Error(ErrorCode::usage, fmt::format("light was captured through a pupil of {}, too narrow for one of {}",
                                                  format_length(pupil_), format_length(camera.pupil)));
    if (defocus_blur(camera) > blur_ * rounding)
        throw Error(ErrorCode::usage, fmt::format("light was captured for focuses nearer to the hologram than {}",
                                                  format_length(camera.focus_depth)));
    Array<float, 2> intensity = film_.unexposed();
    film_.expose(looks_, camera, intensity);
    Image picture(camera.picture.width, camera.picture.height, 1);
    film_.develop(intensity, camera, Rectangle(plane_), 1 / static_cast<double>(looks_.size()), picture);
    return picture;
}

std::vector<CapturedEye> capture(const FieldSource& hologram, std::span<const Camera> cameras,
                                 const PhotographOptions& options, const Progress& progress) {
    const std::vector<Eye> eyes = eyes_of(cameras);
    std::vector<Camera> widest;
    for (const Eye& eye : eyes) widest.push_back(eye.widest);
    const auto memory = static_cast<double>(options.memory);
    const PhotographPlan plan = plan_photographs(hologram.grid(), widest, memory, PhotographPlan::Windows::one);
    const std::size_t looks = hologram.looks(), looks_at_once = plan.looks_at_once(memory, looks);
    const double parts = static_cast<double>(plan.passes.size()) * static_cast<double>(looks);
    std::vector<std::optional<CapturedEye>> captured(eyes.size());
    std::size_t done = 0;
    for (const std::vector<std::size_t>& pass : plan.passes) {
        std::vector<narrow_band::NarrowBand> bands;
        for (std::size_t i : pass) {
            bands.emplace_back(hologram.grid(), widest[i].eye, widest[i].pupil);
            captured[i] = CapturedEye(hologram.grid(), bands.back(), widest[i].pupil, eyes[i].blur);
        }
        for (std::size_t first = 0; first < looks; first += looks_at_once) {
            const std::size_t count = std::min(looks_at_once, looks - first);
            auto drawn = narrow_band::draw_narrow_bands(hologram, bands, first, count, [&](double fraction) {
                return !progress ||
                       progress((static_cast<double>(done) + 0.95 * fraction * static_cast<double>(count)) / parts);
            });
            for (std::size_t e = 0; e < pass.size(); ++e)
                for (auto& band : drawn[e]) {
                    captured[pass[e]]->looks_.push_back(captured[pass[e]]->film_.pupil_wave(band));
                    band = {};
                }
            done += count;
            progress.report(static_cast<double>(done) / parts);
        }
    }
    std::vector<CapturedEye> result;
    for (auto& eye : captured) result.push_back(std::move(*eye));
    return result;
}

}  // namespace hogel::optics
