// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hogel/camera.h"
#include "hogel/export.h"
#include "hogel/image.h"
#include "hogel/light_field.h"
#include "hogel/resources.h"

namespace hogel {

/// The camera that photographs light fields by geometric optics.
struct RayCamera {
    std::size_t pupil_samples = 64;  ///< points of the pupil, spread evenly over the disc
};

/// Photographs a light field by geometric optics, one image per camera. A pixel is the mean radiance, over the pupil,
/// of the rays that meet at the pixel's point of the plane in focus. This is the reference with which photographs of
/// holograms are compared. Rays are interpolated linearly in all four dimensions; rays outside the hologram or the
/// field of view are black. In a hemicube a ray is looked up in the first face that has its direction. Memory: one
/// picture per camera and a tile of hogels. Cost: pupil samples × (hogels + pixels) per camera. Throws Error(usage) for
/// a camera that makes no sense, and for a tilted plane in focus.
HOGEL_API std::vector<Image> photograph(const LightField& light_field, std::span<const Camera> cameras,
                                        const RayCamera& model = {}, const Progress& progress = {});

/// As photograph() into `pictures`, one per camera, whose memory is reused if they have the cameras' shapes. Also
/// throws Error(usage) for another number of pictures.
HOGEL_API void photograph_into(const LightField& light_field, std::span<const Camera> cameras, const RayCamera& model,
                               std::span<Image> pictures, const Progress& progress = {});

/// Resources to photograph a light field by rays, without the cost of reading it.
HOGEL_API Plan plan_ray_photographs(std::span<const LightFieldGrid> faces, std::span<const Camera> cameras,
                                    const RayCamera& model = {});

/// Options of RayPhotographer.
struct RayPhotographerOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< bytes for the samples of the light field
};

/// Photographs a light field by rays from one eye after the other, for interactive use. It keeps all samples in memory,
/// ordered by direction, because an eye sees neighbouring hogels in nearly the same direction: floats if they fit,
/// otherwise halves (binary16). Pictures are those of photograph(), to the last bit from floats. For one thread at a
/// time.
class HOGEL_API RayPhotographer {
  public:
    /// Reads the whole light field. One with the sides of a hemicube or with directions uniform in sines is kept and
    /// read as it is, by each photograph. Throws Error(usage) if halves need more than options.memory, naming what they
    /// need.
    explicit RayPhotographer(LightField light_field, const RayPhotographerOptions& options = {},
                             const Progress& progress = {});
    ~RayPhotographer();
    RayPhotographer(RayPhotographer&&) noexcept;
    RayPhotographer& operator=(RayPhotographer&&) noexcept;

    /// Throws Error(usage) as hogel::photograph() does, and Error(cancelled).
    Image photograph(const Camera& camera, const RayCamera& model = {}, const Progress& progress = {});
    /// As photograph() into `picture`, whose memory is reused if it has the camera's shape.
    void photograph_into(const Camera& camera, const RayCamera& model, Image& picture, const Progress& progress = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace hogel
