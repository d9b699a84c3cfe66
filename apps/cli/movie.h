// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hogel/image.h"

namespace hogel::cli {

/// Whether a name is that of a film: .mp4, .gif or .apng, without numbers.
bool is_film(const std::filesystem::path& path);
/// Whether a name is that of several pictures: name####.png, numbered from 0, or a film.
bool is_movie(const std::filesystem::path& path);

/// Throws Error(usage) for a name that is_movie() refuses, Error(not_built_in) for a movie file if ffmpeg is not
/// installed.
void require_movie(const std::filesystem::path& path);

/// Writes pictures as numbered files, or as a movie made by ffmpeg, and returns their size in bytes. Throws
/// Error(cannot_write).
std::uintmax_t write_movie(const std::filesystem::path& path, std::span<const Image> frames, double exposure,
                           double frames_a_second, const Metadata& metadata);

}  // namespace hogel::cli
