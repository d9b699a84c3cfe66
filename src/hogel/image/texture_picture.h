// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "hogel/image.h"

namespace hogel::image {

/// Interpretation of texture samples.
enum class TexturePixels {
    color,            ///< as in read_image()
    color_and_alpha,  ///< plus alpha, 0 to 1 without a transfer curve, as a fourth channel if the file has it
    numbers           ///< 0 to 1 without a transfer curve, without alpha
};

/// As decode_image() and read_image(), with the given interpretation.
Image decode_texture(std::span<const unsigned char> bytes, const std::string& name, TexturePixels pixels);
Image read_texture(const std::filesystem::path& path, TexturePixels pixels);

}  // namespace hogel::image
