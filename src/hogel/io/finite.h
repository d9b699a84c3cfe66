// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <filesystem>
#include <span>

#include "hogel/array.h"
#include "hogel/field.h"
#include "hogel/geometry.h"
#include "hogel/light_field.h"

namespace hogel::io {

/// Returns whether all elements are finite.
bool all_finite(std::span<const float> values);

/// Throws Error(bad_input), naming the radiance of a tile that is not finite.
[[noreturn]] void throw_not_finite(const LightFieldTile& tile, const std::filesystem::path& path);

/// Throws Error(bad_input), naming the first non-finite sample of field number `field` of a file.
/// @param region  position of the samples in the field
void require_finite(View<const std::complex<float>, 2> samples, const Region& region, std::size_t field,
                    const std::filesystem::path& path);
void require_finite(const Field& samples, std::size_t field, const std::filesystem::path& path);

/// Returns the light field with a check that throws the same error when a radiance that is read is not finite.
LightField require_finite(const LightField& light_field, const std::filesystem::path& path);

}  // namespace hogel::io
