// SPDX-License-Identifier: Apache-2.0
#include "hogel/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "hogel/error.h"

namespace hogel {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0; }

[[noreturn]] void fail(const char* parameter, const std::string& why) {
    throw Error(ErrorCode::usage, parameter, "camera: " + why);
}

}  // namespace

double focus_ratio(const Camera& camera, double x, double y) {
    const Vec3& eye = camera.eye;
    const double slope_x = camera.focus_slope_x, slope_y = camera.focus_slope_y;
    return (eye.z + camera.focus_depth + slope_x * eye.x + slope_y * eye.y) /
           (eye.z - slope_x * (x - eye.x) - slope_y * (y - eye.y));
}

void validate(const Camera& camera) {
    const Vec3& eye = camera.eye;
    if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !positive(eye.z))
        fail("eye", fmt::format("the eye ({}, {}, {}) must be finite and in front of the hologram, z > 0", eye.x, eye.y,
                                eye.z));
    if (!std::isfinite(camera.focus_depth) || camera.focus_depth <= -eye.z)
        fail("focus",
             fmt::format("the focus at depth {} m must be finite and in front of the eye, which is at depth {} m",
                         camera.focus_depth, -eye.z));
    if (!positive(camera.pupil))
        fail("pupil", fmt::format("the pupil is {} m, but must be positive and finite", camera.pupil));
    const Grid& picture = camera.picture;
    if (picture.width == 0 || picture.height == 0)
        fail("resolution", fmt::format("a picture of {}x{} pixels has no pixels", picture.width, picture.height));
    constexpr std::size_t max_pixels = std::numeric_limits<std::size_t>::max() / (8 * sizeof(double));
    if (picture.width > max_pixels / picture.height)
        fail("resolution",
             fmt::format("a picture of {}x{} pixels is larger than can be addressed", picture.width, picture.height));
    if (!positive(picture.pitch_x) || !positive(picture.pitch_y) || !std::isfinite(picture.size_x()) ||
        !std::isfinite(picture.size_y()))
        fail("resolution", fmt::format("the pixel pitch is {} x {} m, but must be positive and finite", picture.pitch_x,
                                       picture.pitch_y));
    if (!std::isfinite(picture.center_x) || !std::isfinite(picture.center_y))
        fail("gaze",
             fmt::format("the centre of the picture ({}, {}) is not finite", picture.center_x, picture.center_y));
    if (camera.focus_slope_x == 0 && camera.focus_slope_y == 0) return;
    const double half_x = 0.5 * picture.size_x(), half_y = 0.5 * picture.size_y();
    for (double x : {picture.center_x - half_x, picture.center_x + half_x})
        for (double y : {picture.center_y - half_y, picture.center_y + half_y})
            if (!positive(focus_ratio(camera, x, y)))
                fail("focus_tilt",
                     fmt::format("a plane in focus with the slopes {} and {} is not everywhere in front of the eye",
                                 camera.focus_slope_x, camera.focus_slope_y));
}

}  // namespace hogel
