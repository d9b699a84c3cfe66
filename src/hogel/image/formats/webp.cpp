// SPDX-License-Identifier: Apache-2.0
#include <webp/decode.h>

#include "hogel/image/formats/formats.h"

namespace hogel::image {

Picture read_webp(const PictureBytes& file) {
    if (file.only_texts) return {};
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(file.bytes.data(), file.bytes.size(), &features) != VP8_STATUS_OK) file.fail("it is damaged");
    if (features.has_animation != 0) file.fail("a single picture was expected, not an animation");
    const auto width = static_cast<std::size_t>(features.width), height = static_cast<std::size_t>(features.height);
    file.check_size(width, height, 3, 1);
    Array<std::uint8_t, 3> samples({height, width, 3});
    if (WebPDecodeRGBInto(file.bytes.data(), file.bytes.size(), samples.data(), samples.size(), 3 * features.width) ==
        nullptr)
        file.fail("it is damaged or ends too early");
    return {std::move(samples), {}};
}

}  // namespace hogel::image
