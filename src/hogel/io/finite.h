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

/// Whether no element is infinite or NaN.
bool all_finite(std::span<const float> values);

/// Throws Error(bad_input) for a tile of a file with a radiance that is not finite; says which.
[[noreturn]] void throw_not_finite(const LightFieldTile& tile, const std::filesystem::path& path);

/// Throws Error(bad_input) for samples of a file that are not finite; says which is the first.
/// @param region  of the field that the samples are
/// @param field   the number of the field in its file
void require_finite(View<const std::complex<float>, 2> samples, const Region& region, std::size_t field,
                    const std::filesystem::path& path);
/// The same for a whole field.
void require_finite(const Field& samples, std::size_t field, const std::filesystem::path& path);

/// The same light field, which throws so when a radiance that is read is not finite.
LightField require_finite(const LightField& light_field, const std::filesystem::path& path);

}  // namespace hogel::io
