// SPDX-License-Identifier: Apache-2.0
// Replaces webp.cpp in a build without libwebp.
#include "hogel/image/formats/formats.h"
#include "hogel/image/picture_formats.h"

namespace hogel::image {

Picture read_webp(const PictureBytes& file) {
    refuse_not_built_in(*format_by_extension("a.webp"), file.name, &PictureFormat::read);
}

}  // namespace hogel::image
