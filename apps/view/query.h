// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "hogel/requests.h"

namespace hogel::view {

/// Parses a query string, "eye=0,0,300mm&focus=5mm". Throws Error(usage) if it is malformed, too long or repeats a
/// name.
std::map<std::string, std::string> parse_query(std::string_view query);

/// Method of a picture.
enum class PictureMethod {
    rays,
    waves,
    side,        ///< rays and waves side by side, rays left
    difference,  ///< magnitude of the difference of rays and waves
    original,    ///< by rays, of the original of a compressed light field
    error,       ///< magnitude of the difference from the original, by rays
};
constexpr bool needs_waves(PictureMethod by) {
    return by == PictureMethod::waves || by == PictureMethod::side || by == PictureMethod::difference;
}

/// Parameters of one picture. Their names are the options of `hogel photo` without dashes, and
/// CameraParameters::cameras() converts them to the same camera.
struct PictureQuery {
    CameraParameters camera;
    std::size_t pupil_samples = 16;
    PictureMethod by = PictureMethod::rays;
    std::size_t looks = 0;        ///< looks to average, by waves; 0: all of the hologram
    bool preview = false;         ///< skips waves far from the pupil, in motion
    double eyes = 0;              ///< distance of two viewpoints, metres, pictures side by side; 0: one viewpoint
    double exposure = 0;          ///< 0: automatic
    bool logarithmic = false;     ///< display=log
    std::string format = "jpeg";  ///< jpeg, png or exr
    int quality = 90;             ///< of JPEG, 1 to 100
    bool moving = false;          ///< requested while dragging: see Worker::Job
    std::string id;               ///< returned with the picture
};

/// Reads the parameters of a picture. Throws Error(usage) with the name of the bad parameter.
PictureQuery parse_picture_query(const std::map<std::string, std::string>& words);

/// Returns the query of one of two viewpoints. @param side  −1: left, 1: right
PictureQuery query_of_eye(PictureQuery query, int side);

/// Point of a picture, 0 to 1 to the right and down.
struct PickPoint {
    double x = 0, y = 0;
};
PickPoint parse_pick_point(const std::map<std::string, std::string>& words);

/// Picture of the data at a point; `what` is a kind that the viewable supports ("hogel", "spectrum").
struct InsideQuery {
    std::string what;
    std::size_t colour = 0;  ///< index of the hologram
    std::size_t side = 256;  ///< pixels
};
InsideQuery parse_inside(const std::map<std::string, std::string>& words);

}  // namespace hogel::view
