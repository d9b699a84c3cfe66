// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hogel/camera.h"
#include "hogel/image.h"
#include "hogel/work/ordered_reduce.h"

namespace hogel::image {

/// Throws Error(usage) unless there is one picture per camera.
void require_a_picture_for_each(std::span<const Camera> cameras, std::span<const Image> pictures);

/// Makes the pictures black with the shapes of the cameras. Sets their provenance: the camera and the source.
void load_film(std::span<const Camera> cameras, std::size_t channels, const Provenance& source,
               std::span<Image> pictures);

/// Returns the serialisation of pictures between ranks and in checkpoints.
work::Sent<std::vector<Image>> sent_pictures();

}  // namespace hogel::image
