// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "hogel/requests.h"

namespace hogel::view {

/// The words of a query, "eye=0,0,300mm&focus=5mm". Throws Error(usage) for one that is damaged, too long or has a name
/// twice.
std::map<std::string, std::string> parse_query(std::string_view query);

/// How a picture is made.
enum class By {
    rays,
    waves,
    side,        ///< both, side by side, rays left
    difference,  ///< the magnitude of their difference
    original,    ///< by rays, of what a compressed light field was made of
    error,       ///< the magnitude of the difference from that, by rays
};
constexpr bool needs_waves(By by) { return by == By::waves || by == By::side || by == By::difference; }

/// One picture, in words that are the options of `hogel photo` without their dashes. So a query, the address of the
/// page and a command line say the same, and CameraParameters::cameras() makes the same camera of them.
struct View {
    CameraParameters camera;
    std::size_t pupil_samples = 16;
    By by = By::rays;
    std::size_t looks = 0;  ///< of waves, whose mean is shown; 0: all of the subject
    bool preview = false;   ///< by waves without those that pass far from the pupil, while something is dragged
    double eyes = 0;      ///< metres between two eyes, whose pictures stand side by side, the left one left; 0: one eye
    double exposure = 0;  ///< 0: the automatic one of the light field
    bool logarithmic = false;     ///< display=log
    std::string format = "jpeg";  ///< jpeg, png or exr
    int quality = 90;             ///< of a JPEG picture
    bool moving = false;          ///< asked for while something is dragged: see Worker::Job
    std::string id;               ///< comes back with the picture
};

/// Throws Error(usage), whose parameter is the word.
View parse_view(const std::map<std::string, std::string>& words);

/// The view of one of two eyes: −1 the left one, 1 the right one.
View of_eye(View view, int side);

/// A point of a picture, 0 to 1 to the right and down, with the view that it is in.
struct PickPoint {
    double x = 0, y = 0;
};
PickPoint parse_pick_point(const std::map<std::string, std::string>& words);

/// What a look inside shows: a word that the subject knows ("hogel", "fringes", "spectrum").
struct Inside {
    std::string what;
    std::size_t colour = 0;  ///< of several holograms
    std::size_t side = 256;  ///< pixels
};
Inside parse_inside(const std::map<std::string, std::string>& words);

}  // namespace hogel::view
