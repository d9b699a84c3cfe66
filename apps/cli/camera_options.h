// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "command_line.h"
#include "hogel/camera.h"
#include "hogel/pipeline.h"
#include "run_record.h"

namespace hogel::cli {

/// The options that describe cameras.
struct CameraOptions {
    Vec3 eye{0, 0, defaults.eye_distance}, gaze;
    double focus = 0;
    Angles focus_tilt;
    double pupil = defaults.pupil, f_number = 0, focal_length = defaults.focal_length;
    double angle_of_view = 0;  ///< horizontal; 0: the angle that frames the hologram
    Counts resolution{defaults.resolution, 0};

    Vec3 last_eye;
    double last_focus = 0;
    std::size_t frames = 1;
    double frame_rate = defaults.frame_rate;
    bool moves_eye = false, moves_focus = false;
};
void add_camera_options(Command& command, CameraOptions& options);

/// The cameras of all frames, for a hologram of this size. Throws Error(usage).
std::vector<Camera> make_cameras(const CameraOptions& options, double width, double height);

/// Records the camera's options; that of the frame rate acts on films alone.
void record_camera(RunRecord& record, const CameraOptions& options, bool film);

}  // namespace hogel::cli
