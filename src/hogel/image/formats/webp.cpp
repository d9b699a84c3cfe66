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
    const bool alpha = file.with_alpha && features.has_alpha != 0;
    const std::size_t channels = alpha ? 4 : 3;
    file.check_size(width, height, channels, 1);
    Array<std::uint8_t, 3> samples({height, width, channels});
    const int row = static_cast<int>(channels) * features.width;
    const auto decode = alpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (decode(file.bytes.data(), file.bytes.size(), samples.data(), samples.size(), row) == nullptr)
        file.fail("it is damaged or ends too early");
    return {std::move(samples), {}};
}

}  // namespace hogel::image
