#include "hogel/image/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "hogel/core/error.h"

namespace hogel {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0; }

[[noreturn]] void fail(const std::string& why) { throw Error(ErrorCode::usage, "camera: " + why); }

}  // namespace

void validate(const Camera& camera) {
    const Vec3& eye = camera.eye;
    if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !positive(eye.z))
        fail(fmt::format("the eye ({}, {}, {}) must be finite and in front of the hologram, z > 0", eye.x, eye.y,
                         eye.z));
    if (!std::isfinite(camera.focus_depth) || camera.focus_depth <= -eye.z)
        fail(fmt::format("the focus at depth {} m must be finite and in front of the eye, which is at depth {} m",
                         camera.focus_depth, -eye.z));
    if (!positive(camera.pupil)) fail(fmt::format("the pupil is {} m, but must be positive and finite", camera.pupil));
    const Grid& picture = camera.picture;
    if (picture.width == 0 || picture.height == 0)
        fail(fmt::format("a picture of {}x{} pixels was asked for", picture.width, picture.height));
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / (8 * sizeof(double));
    if (picture.width > most / picture.height)
        fail(fmt::format("a picture of {}x{} pixels is larger than can be addressed", picture.width, picture.height));
    if (!positive(picture.pitch_x) || !positive(picture.pitch_y) || !std::isfinite(picture.size_x()) ||
        !std::isfinite(picture.size_y()))
        fail(fmt::format("the pixel pitch is {} x {} m, but must be positive and finite", picture.pitch_x,
                         picture.pitch_y));
    if (!std::isfinite(picture.center_x) || !std::isfinite(picture.center_y))
        fail(fmt::format("the centre of the picture ({}, {}) is not finite", picture.center_x, picture.center_y));
}

}  // namespace hogel
