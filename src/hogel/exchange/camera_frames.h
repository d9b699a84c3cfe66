// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "hogel/exchange/view_set.h"
#include "hogel/geometry.h"

/// Cameras as files of calibrated pictures describe them, one by one, and the grid of parallel cameras that they may
/// be.
namespace hogel::exchange {

/// One camera of transforms.json.
struct CameraFrame {
    std::filesystem::path picture;  ///< in the file's folder or below
    /// Its axes in the file's frame: to the right, up, and backwards (OpenGL), of length 1 and perpendicular.
    std::array<Vec3, 3> axes{};
    Vec3 place;
    double width = 0, height = 0;     ///< of the picture as the file or the picture says it, pixels
    double focal_x = 0, focal_y = 0;  ///< focal length in pixels
    double center_x = 0,
           center_y = 0;  ///< the point of the picture on the optical axis, pixels from its top left corner
};

/// Reads transforms.json of nerfstudio and instant-ngp. Throws Error(bad_input) with the file and the place in it for
/// what is missing or no number, for pictures that do not exist, and for cameras that are no pinholes.
std::vector<CameraFrame> read_camera_frames(const std::filesystem::path& file);

/// Frames in rows and columns.
struct CameraGrid {
    std::size_t rows = 0, columns = 0;
    std::vector<std::size_t> frames;  ///< [row from the top][column from the left]: the index of a frame
    ViewGeometry geometry;
    std::vector<std::string> notes;
};

/// Arranges the cameras in rows and columns, in the order in which they are seen from behind, looking ahead. Throws
/// Error(bad_input), naming the file and a frame, for cameras that are turned against each other, that do not stand on
/// a plane parallel to their pictures, that leave a place empty or stand at the same one, whose focal lengths differ,
/// or whose pictures agree on no plane.
/// @param width, height  of every picture, pixels
CameraGrid arrange(const std::filesystem::path& file, const std::vector<CameraFrame>& frames, std::size_t width,
                   std::size_t height);

}  // namespace hogel::exchange
