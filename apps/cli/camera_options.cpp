// SPDX-License-Identifier: Apache-2.0
#include "camera_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::cli {
namespace {

constexpr std::size_t max_pixels = std::size_t{1} << 30;

double mix(double a, double b, double part) { return a + part * (b - a); }

Camera make_camera(const CameraOptions& options, double width, double height, double part) {
    Camera camera;
    camera.eye = options.moves_eye ? options.eye + part * (options.last_eye - options.eye) : options.eye;
    camera.focus_depth = options.moves_focus ? mix(options.focus, options.last_focus, part) : options.focus;
    camera.focus_slope_x = std::tan(options.focus_tilt.across);
    camera.focus_slope_y = std::tan(options.focus_tilt.down);
    camera.pupil = options.f_number > 0 ? options.focal_length / options.f_number : options.pupil;
    if (!(camera.eye.z > 0))
        throw Error(
            ErrorCode::usage, "eye",
            fmt::format("the eye is in front of the hologram, at z > 0, not at {}", format_length(camera.eye.z)));
    if (!(options.gaze.z < camera.eye.z))
        throw Error(ErrorCode::usage, "gaze", "the eye looks at a point in front of it, not beside or behind it");
    // The middle of the picture is where the line of sight to that point meets the hologram plane.
    const Vec3 middle = camera.eye + camera.eye.z / (camera.eye.z - options.gaze.z) * (options.gaze - camera.eye);
    const double shown = options.angle_of_view > 0 ? 2 * camera.eye.z * std::tan(0.5 * options.angle_of_view) : width;
    const double pixel = shown / static_cast<double>(options.resolution.columns);
    std::size_t rows = options.resolution.rows;
    if (rows == 0)
        rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(shown * height / width / pixel)));
    if (options.resolution.columns * rows > max_pixels)
        throw Error(ErrorCode::usage, fmt::format("--resolution: {}x{} pixels; expected at most {} in all",
                                                  options.resolution.columns, rows, max_pixels));
    camera.picture = {options.resolution.columns, rows, pixel, pixel, middle.x, middle.y};
    validate(camera);
    return camera;
}

}  // namespace

void add_camera_options(Command& command, CameraOptions& options) {
    command.group("Camera");
    command.point("--eye", options.eye, "Centre of the lens; the hologram is around 0,0,0");
    command.point("--gaze", options.gaze, "What is in the middle of the picture");
    command.length("--focus", options.focus, "Depth in focus: positive behind the hologram, negative in front");
    command.angles("--focus-tilt", options.focus_tilt,
                   "Tilt of the plane in focus, as by a tilted film: its depth grows to the right and upwards, by one "
                   "angle for both or by one each");
    const Parameter& pupil =
        command.positive_length("--pupil", options.pupil, "Diameter of the lens").acts_if([&options] {
            return options.f_number == 0;
        });
    command.number("--f-number", options.f_number, "NUMBER", "The same as a part of the focal length")
        .no_default()
        .positive()
        .excludes(pupil)
        .sets_parameter("pupil");
    command.positive_length("--focal-length", options.focal_length, "With --f-number").acts_if([&options] {
        return options.f_number > 0;
    });
    command.angle("--angle-of-view", options.angle_of_view, "Across; 0deg: what shows the hologram")
        .sets_parameter("resolution");
    command.resolution("--resolution", options.resolution, "Pixels across, or across and down");
    command.point("--to-eye", options.last_eye, "The eye of the last frame")
        .no_default()
        .sets(options.moves_eye)
        .sets_parameter("eye");
    command.length("--to-focus", options.last_focus, "The depth in focus of the last frame")
        .no_default()
        .sets(options.moves_focus)
        .sets_parameter("focus");
    command.count("--frames", options.frames, "Pictures on the way, for an output .mp4, .gif, .apng or name####.png")
        .acts_if([&options] { return options.frames > 1; });
    command.number("--frame-rate", options.frame_rate, "NUMBER", "Frames a second of a film")
        .positive()
        .acts_if([&options] { return options.is_film; });
}

std::vector<Camera> make_cameras(const CameraOptions& options, double width, double height) {
    for (const double tilt : {options.focus_tilt.across, options.focus_tilt.down})
        if (!(std::abs(tilt) < 0.5 * std::numbers::pi))
            throw Error(ErrorCode::usage, "focus_tilt", "angles between -90deg and 90deg were expected");
    if (options.frames == 1 && (options.moves_eye || options.moves_focus))
        throw Error(ErrorCode::usage, "--to-eye and --to-focus: with --frames, for there is but one picture");
    if (!(options.angle_of_view >= 0 && options.angle_of_view < 3.1))
        throw Error(ErrorCode::usage, "angle_of_view", "an angle below 180deg was expected");
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < options.frames; ++i)
        cameras.push_back(
            make_camera(options, width, height,
                        options.frames > 1 ? static_cast<double>(i) / static_cast<double>(options.frames - 1) : 0));
    return cameras;
}

Parameter& add_wave_camera_option(Command& command, std::string& camera, const std::vector<std::string>& names) {
    const bool full = std::ranges::count(names, "full") > 0;
    std::vector<std::string> words = names;
    words.insert(words.end(), {"hogel-spectra", "samples"});
    if (full) words.emplace_back("plane-waves");
    return command.choice(
        "--camera", camera, words, fmt::format("{}", fmt::join(names, "|")),
        std::string("How waves are photographed:"
                    "\nauto: eye where the hogels are known and that is cheaper, otherwise narrow"
                    "\neye, hogel-spectra: the few numbers of each hogel that enter the lens"
                    "\nnarrow, samples: the band that enters the lens, from all samples, tile by tile") +
            (full ? "\nfull, plane-waves: plane waves to the lens and back, exact and slow" : ""));
}

std::string camera_name(const std::string& word) {
    return word == "hogel-spectra" ? "eye" : word == "samples" ? "narrow" : word == "plane-waves" ? "full" : word;
}

CameraModel camera_model(const std::string& camera, bool expected) {
    if (expected) return SpeckleFreeCamera();
    return BandCamera{.source = camera == "eye"      ? BandSource::hogel_spectra
                                : camera == "narrow" ? BandSource::samples
                                                     : BandSource::automatic};
}

std::string say_camera(const Session& session, std::span<const LightFieldGrid> faces, const HologramRequest& request,
                       std::span<const Camera> cameras, const CameraModel& model) {
    const BandSourceChoice choice = choose_band_source(faces, request, cameras, model);
    const auto* const band = std::get_if<BandCamera>(&model);
    if (band != nullptr && band->preview && choice.source != BandSource::hogel_spectra)
        throw Error(ErrorCode::usage, fmt::format("--preview: {}; leave it out", choice.reason));
    if (band != nullptr && band->source == BandSource::hogel_spectra && choice.source != BandSource::hogel_spectra)
        throw Error(ErrorCode::usage, fmt::format("--camera eye: {}; --camera narrow would do", choice.reason));
    std::string name = choice.source == BandSource::hogel_spectra ? "eye" : "narrow";
    session.detail(fmt::format("camera: {}, because {}", name, choice.reason));
    return name;
}

Parameter& add_looks_option(Command& command, const std::string& names, std::string& text, const std::string& help) {
    return command.text(names, text, "NUMBER|expected",
                        help + "\nexpected: the mean of infinitely many, without speckle");
}

Looks parse_looks(const std::string& text) {
    if (text == "expected") return {1, true};
    constexpr double max_looks = 1 << 24;
    const std::optional<double> number = parse_number(text);
    if (!number || !(*number >= 1 && *number <= max_looks) || *number != std::floor(*number))
        throw Error(ErrorCode::usage, fmt::format("--looks: '{}' is neither a number of pictures from 1 to {:.0f} nor "
                                                  "expected",
                                                  text, max_looks));
    return {static_cast<std::size_t>(*number), false};
}

}  // namespace hogel::cli
