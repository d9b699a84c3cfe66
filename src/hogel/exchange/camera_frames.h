// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "hogel/exchange/view_set.h"
#include "hogel/geometry.h"

/// Cameras as described by files of calibrated pictures, and their arrangement as a grid of parallel cameras.
namespace hogel::exchange {

/// One camera of transforms.json.
struct CameraFrame {
    std::filesystem::path picture;  ///< path in the folder of the file or below
    /// Camera axes in the file's frame: right, up and backwards (OpenGL), orthonormal.
    std::array<Vec3, 3> axes{};
    Vec3 position;
    double width = 0, height = 0;     ///< picture size according to the file, otherwise the picture, in pixels
    double focal_x = 0, focal_y = 0;  ///< focal length in pixels
    double center_x = 0,
           center_y = 0;  ///< the point of the picture on the optical axis, pixels from its top left corner
};

/// Reads transforms.json of nerfstudio and instant-ngp. Throws Error(bad_input), naming file and position, for missing
/// or non-numeric values, missing pictures and cameras that are not pinholes.
std::vector<CameraFrame> read_camera_frames(const std::filesystem::path& file);

struct CameraGrid {
    std::size_t rows = 0, columns = 0;
    std::vector<std::size_t> frames;  ///< [row from the top][column from the left]: index of a frame
    ViewGeometry geometry;
    std::vector<std::string> notes;
};

/// Arranges the cameras in rows and columns, as seen from behind the cameras. Throws Error(bad_input), naming the file
/// and any frame at fault, if cameras are rotated relative to each other, lie off a plane parallel to their pictures or
/// off an even grid, leave a grid position empty or share one, differ in focal length, or if the pictures have no
/// common zero-parallax plane.
/// @param width, height  of every picture, pixels
CameraGrid arrange(const std::filesystem::path& file, const std::vector<CameraFrame>& frames, std::size_t width,
                   std::size_t height);

}  // namespace hogel::exchange
