// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/camera.h"
#include "hogel/optics/film/film.h"

namespace hogel::optics {

/// How photographs of a hologram fit into memory. Cameras are taken some at a time, sorted by eye; the hologram may be
/// photographed window by window, each with a margin around what it shows, because light that enters the pupil from one
/// place falls near its own place of the film. Each such part takes a pass over its window, and of the looks as many at
/// a time as there is room for.
struct PhotographPlan {
    std::vector<std::vector<std::size_t>> passes;  ///< indices of cameras
    struct Window {
        Region region;    ///< what is read
        Rectangle shown;  ///< what the film shows of it
    };
    std::vector<Window> windows;

    double bytes = 0;         ///< at the most, with one look at a time
    double bytes_a_look = 0;  ///< for each further look

    /// How many of `looks` looks there is memory for at a time; at least one.
    std::size_t looks_at_once(double memory, std::size_t looks) const;

    enum class Windows { one, many };
};

/// The plan with least work. Throws Error(usage) where there is none, naming a pupil that would do.
/// @param windows  whether the hologram may be taken in parts
PhotographPlan plan_photographs(const FieldGrid& hologram, std::span<const Camera> cameras, double memory,
                                PhotographPlan::Windows windows = PhotographPlan::Windows::many);

/// The cameras of one pass with one eye: they share its narrow band.
struct SharedEye {
    std::vector<std::size_t> members;  ///< indices of cameras
    double pupil = 0, blur = 0;        ///< the widest
};
std::vector<SharedEye> group_by_eye(std::span<const Camera> cameras, std::span<const std::size_t> members);

}  // namespace hogel::optics
