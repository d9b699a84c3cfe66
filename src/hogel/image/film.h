// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::image {

/// Throws Error(usage) unless there is one picture for each camera.
void require_a_picture_for_each(std::span<const Camera> cameras, std::span<const Image> pictures);

/// Makes the pictures black with the cameras' shapes, and sets their provenance: the camera and the origin of the
/// object.
void load_film(std::span<const Camera> cameras, std::size_t channels, const Provenance& subject,
               std::span<Image> pictures);

/// How pictures travel between processes, and are kept.
work::Sent<std::vector<Image>> sent_pictures();

}  // namespace hogel::image
