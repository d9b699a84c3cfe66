// SPDX-License-Identifier: Apache-2.0
// Replaces tiff.cpp in a build without libtiff.
#include "hogel/image/formats/formats.h"
#include "hogel/image/picture_formats.h"

namespace hogel::image {

Picture read_tiff(const PictureBytes& file) {
    refuse_not_built_in(*format_by_extension("a.tif"), file.name, &PictureFormat::read);
}

std::vector<unsigned char> tiff_file(View<const std::uint8_t, 3>, const Metadata&) {
    refuse_not_built_in(*format_by_extension("a.tif"), "a picture", &PictureFormat::written_as_picture);
}

}  // namespace hogel::image
