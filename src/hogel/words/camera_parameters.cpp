// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/requests.h"
#include "hogel/units.h"

namespace hogel {
namespace {

constexpr std::size_t max_pixels = std::size_t{1} << 30;

// Returns the pixel grid in the hologram plane, centred on its intersection with the line from the eye to `gaze`.
Grid picture_of(const CameraParameters& options, const Vec3& eye, double width, double height) {
    const Vec3 middle = eye + eye.z / (eye.z - options.gaze.z) * (options.gaze - eye);
    const double shown = options.angle_of_view > 0 ? 2 * eye.z * std::tan(0.5 * options.angle_of_view) : width;
    const auto [columns, fixed_rows] = options.resolution;
    const double pixel = shown / static_cast<double>(columns);
    std::size_t rows = fixed_rows;
    if (rows == 0)
        rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(shown * height / width / pixel)));
    if (columns * rows > max_pixels)
        throw Error(ErrorCode::usage, "resolution",
                    fmt::format("{}x{} pixels; expected at most {} in all", columns, rows, max_pixels));
    return {columns, rows, pixel, pixel, middle.x, middle.y};
}

// @param part  fraction of the path from the first picture to the last, 0 to 1
Camera camera_of(const CameraParameters& options, double width, double height, double part) {
    Camera camera;
    camera.eye = options.eye + part * (options.last_eye.value_or(options.eye) - options.eye);
    camera.focus_depth = options.focus + part * (options.last_focus.value_or(options.focus) - options.focus);
    camera.focus_slope_x = std::tan(options.focus_tilt.across);
    camera.focus_slope_y = std::tan(options.focus_tilt.down);
    camera.pupil = options.f_number ? options.focal_length / *options.f_number : options.pupil;
    if (!(camera.eye.z > 0))
        throw Error(ErrorCode::usage, "eye",
                    fmt::format("the eye must be in front of the hologram, at z > 0; it is at {}",
                                format_length(camera.eye.z)));
    if (!(options.gaze.z < camera.eye.z))
        throw Error(ErrorCode::usage, "gaze", "the point must be in front of the eye, at a smaller z");
    camera.picture = picture_of(options, camera.eye, width, height);
    validate(camera);
    return camera;
}

}  // namespace

std::vector<Camera> CameraParameters::cameras(double width, double height) const {
    for (const double tilt : {focus_tilt.across, focus_tilt.down})
        if (!(std::abs(tilt) < 0.5 * std::numbers::pi))
            throw Error(ErrorCode::usage, "focus_tilt", "expected angles between -90deg and 90deg");
    if (frames == 1 && (last_eye || last_focus))
        throw Error(ErrorCode::usage, "to_eye, to_focus", "need several frames; add frames");
    if (!(angle_of_view >= 0 && angle_of_view < 3.1))
        throw Error(ErrorCode::usage, "angle_of_view", "expected an angle below 180deg");
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < frames; ++i)
        cameras.push_back(
            camera_of(*this, width, height, frames > 1 ? static_cast<double>(i) / static_cast<double>(frames - 1) : 0));
    return cameras;
}

void CameraParameters::declare(Parameters& parameters) {
    const auto is_eye = [this] { return !is_bench; };
    parameters.group("Camera", is_eye);
    parameters.point("--eye", eye, "Centre of the lens; the hologram is centred on 0,0,0");
    parameters.point("--gaze", gaze, "Point in the middle of the picture");
    parameters.group("Camera");
    parameters.length("--focus", focus, "Depth in focus: positive behind the hologram, negative in front");
    parameters.group("Camera", is_eye);
    parameters.angles("--focus-tilt", focus_tilt,
                      "Tilt of the plane in focus, as by a tilted film: its depth grows to the right and upwards; "
                      "one angle for both, or one each");
    const Parameter& diameter =
        parameters.positive_length("--pupil", pupil, "Diameter of the lens").acts_if([this] { return !f_number; });
    parameters
        .number("--f-number", f_number, "NUMBER",
                "Focal length divided by the diameter of the lens, instead of --pupil")
        .positive()
        .excludes(diameter)
        .sets_parameter("pupil");
    parameters.positive_length("--focal-length", focal_length, "Focal length of the lens, for --f-number")
        .acts_if([this] { return f_number.has_value(); });
    parameters.angle("--angle-of-view", angle_of_view, "Horizontal angle of view; 0deg: the width of the hologram")
        .sets_parameter("resolution");
    parameters.resolution("--resolution", resolution, "Pixels across, or across and down");
}

void CameraParameters::declare_motion(Parameters& parameters) {
    parameters.group("Camera");
    parameters.point("--to-eye", last_eye, "Centre of the lens in the last frame").sets_parameter("eye");
    parameters.length("--to-focus", last_focus, "Depth in focus in the last frame").sets_parameter("focus");
    parameters.count("--frames", frames, "Number of frames, for an output .mp4, .gif, .apng or name####.png")
        .acts_if([this] { return frames > 1; });
    parameters.number("--frame-rate", frame_rate, "NUMBER", "Frames per second of a film").positive().acts_if([this] {
        return is_film;
    });
}

}  // namespace hogel
