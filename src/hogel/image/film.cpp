// SPDX-License-Identifier: Apache-2.0
#include "hogel/image/film.h"

#include <fmt/format.h>

#include <algorithm>

#include "hogel/error.h"

namespace hogel::image {

void require_a_picture_for_each(std::span<const Camera> cameras, std::span<const Image> pictures) {
    if (cameras.size() != pictures.size())
        throw Error(ErrorCode::usage, fmt::format("{} pictures for {} cameras; expected one per camera",
                                                  pictures.size(), cameras.size()));
}

void load_film(std::span<const Camera> cameras, std::size_t channels, const Provenance& source,
               std::span<Image> pictures) {
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        pictures[i].reset(cameras[i].picture.width, cameras[i].picture.height, channels);
        pictures[i].provenance = {to_metadata(source), cameras[i]};
    }
}

work::Sent<std::vector<Image>> sent_pictures() {
    return {[](work::MessageWriter& message, const std::vector<Image>& pictures) {
                message.put(pictures.size());
                for (const Image& picture : pictures) message.put(picture.pixels);
            },
            [](work::MessageReader& message) {
                std::vector<Image> pictures(message.get<std::size_t>());
                for (Image& picture : pictures) picture.pixels = message.get_array<float, 3>();
                return pictures;
            }};
}

}  // namespace hogel::image

namespace hogel {

void Image::reset(std::size_t width, std::size_t height, std::size_t channels) {
    const Shape<3> shape{height, width, channels};
    if (pixels.shape() == shape)
        std::ranges::fill(pixels.elements(), 0.0f);
    else
        pixels = Array<float, 3>(shape);
    provenance = {};
}

}  // namespace hogel
