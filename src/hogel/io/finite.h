// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "hogel/light_field.h"

namespace hogel::io {

/// Whether no element is infinite or NaN.
bool all_finite(std::span<const float> values);

/// Throws Error(bad_input) for a tile of a file with a radiance that is not finite; says which.
[[noreturn]] void throw_not_finite(const LightFieldTile& tile, const std::filesystem::path& path);

/// The same light field, which throws so when a radiance that is read is not finite.
LightField require_finite(const LightField& light_field, const std::filesystem::path& path);

}  // namespace hogel::io
