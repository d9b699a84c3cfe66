// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hogel/export.h"
#include "hogel/image.h"

namespace hogel {

/// The bytes of an 8-bit sRGB JPEG file, for pictures on their way to a screen: baseline, without metadata, colours at
/// half the resolution below a quality of 90. `quality` is libjpeg's, 1 to 100. Throws Error(usage) for another one or
/// a wrong exposure, Error(not_built_in) in a build without HOGEL_PICTURES.
HOGEL_API std::vector<unsigned char> encode_jpeg(const Image& image, double exposure = 1, int quality = 90);

}  // namespace hogel
