// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "hogel/camera.h"
#include "hogel/camera/film/film.h"

namespace hogel::camera {

/// Division of photographs of a hologram such that they fit into memory. Cameras are divided into passes, sorted by
/// viewpoint. The hologram may be divided into windows. Each has a margin around the part that it shows, because light
/// from a point of the hologram arrives near the corresponding point of the film. Each pass reads each window once for
/// every group of looks that fits into memory.
struct PhotographPlan {
    std::vector<std::vector<std::size_t>> passes;  ///< indices of cameras
    struct Window {
        Region region;  ///< region to read
        /// Area on the film: a part of the hologram, and beside its outer edges the surroundings that light reaches.
        Rectangle shown;
    };
    std::vector<Window> windows;

    double bytes = 0;           ///< peak memory with one look at a time
    double bytes_per_look = 0;  ///< memory of each further look

    /// Returns the number of looks that fit into `memory` bytes at a time, from 1 to `looks`.
    /// @param share  ratio of the actual bytes of a look to bytes_per_look
    std::size_t looks_at_once(double memory, std::size_t looks, double share) const;

    enum class Windows { one, many };
};

/// Returns the area of the hologram and of the surroundings that its light reaches, for this pupil and blur.
/// @param blur         see defocus_blur()
/// @param diffraction  distance beyond half the blur at which light is cut off, metres
Rectangle illuminated_area(const FieldGrid& hologram, const Vec3& viewpoint, double pupil, double blur,
                           double diffraction = std::numeric_limits<double>::infinity());

double narrow_band_bytes(const FieldGrid& hologram, const Vec3& viewpoint, double pupil);

/// Throws Error(usage) for a pupil that resolves fewer than `cells` points side by side on the hologram. With fewer
/// than one a photograph shows a single blur, and the waves that enter the pupil form no narrow band.
void require_resolution(const FieldGrid& hologram, const Camera& camera, double cells = 1);

/// Returns the plan with the least work that fits into `memory` bytes. Throws Error(usage) if none fits; the message
/// names a pupil for which one would.
/// @param windows  whether the hologram may be divided into windows
PhotographPlan plan_photographs(const FieldGrid& hologram, std::span<const Camera> cameras, double memory,
                                PhotographPlan::Windows windows = PhotographPlan::Windows::many);

/// Returns the peak memory of photographs, bytes, if as many looks are computed at a time as fit into `memory` bytes.
/// @param share  ratio of the actual bytes of bands to those of narrow bands
double photograph_bytes(const FieldGrid& hologram, std::span<const Camera> cameras, double memory, std::size_t looks,
                        double share = 1);

/// Returns whether to synthesise all colours together. Then rays are made once, and the bands of all colours are in
/// memory. Otherwise colours follow each other, which makes the rays again and needs a third of the memory. Clearing
/// new memory takes 1 to 3 ns a byte, and a ray 1 to 4 ns; a hologram has about as many rays as samples.
inline bool renders_colours_together(double band_bytes, const Grid& hologram) {
    return band_bytes <= static_cast<double>(hologram.samples());
}

/// Cameras of one pass with the same viewpoint, which share its narrow band.
struct SharedViewpoint {
    std::vector<std::size_t> members;  ///< indices of cameras
    double pupil = 0, blur = 0;        ///< maxima over the cameras
    Rectangle pictures;                ///< bounding rectangle of all pictures
};
std::vector<SharedViewpoint> group_by_viewpoint(std::span<const Camera> cameras, std::span<const std::size_t> members);
std::vector<SharedViewpoint> group_by_viewpoint(std::span<const Camera> cameras);

}  // namespace hogel::camera
