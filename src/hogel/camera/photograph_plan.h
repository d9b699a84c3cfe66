// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "hogel/camera.h"
#include "hogel/camera/film/film.h"

namespace hogel::camera {

/// A plan by which photographs of a hologram fit into memory. Cameras are divided into passes, sorted by eye. The
/// hologram may be divided into windows, each with a margin around the part that it shows, because light from a point
/// of the hologram arrives near the corresponding point of the film. Each window is read once per pass and per group of
/// looks that fit into memory.
struct PhotographPlan {
    std::vector<std::vector<std::size_t>> passes;  ///< indices of cameras
    struct Window {
        Region region;  ///< what is read
        /// What the film shows: a part of the hologram, and beside its outer edges the surroundings that light reaches.
        Rectangle shown;
    };
    std::vector<Window> windows;

    double bytes = 0;           ///< maximum, with one look at a time
    double bytes_per_look = 0;  ///< for each further look

    /// The number of looks, of `looks`, that fit into memory at a time; at least one.
    /// @param share  of bytes_per_look that a look needs
    std::size_t looks_at_once(double memory, std::size_t looks, double share) const;

    enum class Windows { one, many };
};

/// The hologram and the surroundings that its light reaches in pictures of an eye with this pupil and blur.
/// @param diffraction  metres beyond half the blur where light is followed no farther
Rectangle illuminated_area(const FieldGrid& hologram, const Vec3& eye, double pupil, double blur,
                           double diffraction = std::numeric_limits<double>::infinity());

/// The memory of an eye's narrow band, of one look.
double narrow_band_bytes(const FieldGrid& hologram, const Vec3& eye, double pupil);

/// Throws Error(usage) for a pupil that resolves fewer than `cells` points side by side on the hologram. With less than
/// one a photograph shows one blur, and the waves that enter the pupil are no narrow band.
void require_resolution(const FieldGrid& hologram, const Camera& camera, double cells = 1);

/// The plan with the least work. Throws Error(usage) if there is none, naming a pupil that would be possible.
/// @param windows  whether the hologram may be divided into windows
PhotographPlan plan_photographs(const FieldGrid& hologram, std::span<const Camera> cameras, double memory,
                                PhotographPlan::Windows windows = PhotographPlan::Windows::many);

/// Bytes of photographs of which as many looks are computed together as there is memory for.
/// @param share  of the memory of narrow bands that bands take
double photograph_bytes(const FieldGrid& hologram, std::span<const Camera> cameras, double memory, std::size_t looks,
                        double share = 1);

/// Whether colours are drawn together, from rays that are made once, with the bands of all colours in memory; otherwise
/// one is drawn after the other, which makes the rays again and needs a third of the memory. New memory is not free:
/// the system clears it at one to three nanoseconds a byte, and a ray, of which a hologram has about as many as
/// samples, is made in one to four.
/// @param band_bytes  of all eyes and looks of a colour
inline bool renders_colours_together(double band_bytes, const Grid& hologram) {
    return band_bytes <= static_cast<double>(hologram.samples());
}

/// The cameras of one pass with one eye: they share its narrow band.
struct SharedViewpoint {
    std::vector<std::size_t> members;  ///< indices of cameras
    double pupil = 0, blur = 0;        ///< the widest
    Rectangle pictures;                ///< around all
};
std::vector<SharedViewpoint> group_by_viewpoint(std::span<const Camera> cameras, std::span<const std::size_t> members);
/// All cameras.
std::vector<SharedViewpoint> group_by_viewpoint(std::span<const Camera> cameras);

}  // namespace hogel::camera
