// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "hogel/image.h"

namespace hogel::image {

/// What the samples of a texture mean.
enum class TexturePixels {
    color,            ///< as read_image()
    color_and_alpha,  ///< with alpha, 0 to 1 without a transfer curve, as a fourth channel where the file has one
    numbers           ///< 0 to 1 without a transfer curve, without alpha
};

/// As decode_image() and read_image().
Image decode_texture(std::span<const unsigned char> bytes, const std::string& name, TexturePixels pixels);
Image read_texture(const std::filesystem::path& path, TexturePixels pixels);

}  // namespace hogel::image
