// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "hogel/camera.h"
#include "hogel/pipeline.h"
#include "session.h"

namespace hogel::cli {

/// The options that describe cameras.
struct CameraOptions {
    Vec3 eye{0, 0, defaults.eye_distance}, gaze;
    double focus = 0;
    Angles focus_tilt;
    double pupil = defaults.pupil, f_number = 0, focal_length = defaults.focal_length;
    double angle_of_view = 0;  ///< horizontal; 0: the angle that frames the hologram
    Counts resolution{defaults.resolution, 0};
    bool is_film = false;  ///< whether the frame rate acts

    Vec3 last_eye;
    double last_focus = 0;
    std::size_t frames = 1;
    double frame_rate = defaults.frame_rate;
    bool moves_eye = false, moves_focus = false;
};
void add_camera_options(Command& command, CameraOptions& options);

/// The cameras of all frames, for a hologram of this size. Throws Error(usage).
std::vector<Camera> make_cameras(const CameraOptions& options, double width, double height);

/// --camera, the way in which waves are photographed.
Parameter& add_wave_camera_option(Command& command, std::string& camera, const std::vector<std::string>& names);
/// A word of --camera as auto, eye, narrow or full: the library's words are hogel-spectra, samples and plane-waves.
std::string camera_name(const std::string& word);
/// The model that --camera auto, eye or narrow, and --looks ask for.
CameraModel camera_model(const std::string& camera, bool expected);
/// Says with -v from what photographs are computed, and why; returns its name, eye or narrow. Throws Error(usage) for
/// --camera eye where there are no waves of hogels, or so many of them enter the eye that samples are cheaper.
std::string say_camera(const Session& session, std::span<const LightFieldGrid> faces, const HologramRequest& request,
                       std::span<const Camera> cameras, const CameraModel& model);

/// --looks: a number of looks, or the mean of infinitely many.
struct Looks {
    std::size_t count = 0;
    bool expected = false;
};
/// Adds --looks, whose text is parsed by parse_looks().
Parameter& add_looks_option(Command& command, const std::string& names, std::string& text, const std::string& help);
/// Throws Error(usage).
Looks parse_looks(const std::string& text);

}  // namespace hogel::cli
