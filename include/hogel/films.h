// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "hogel/export.h"
#include "hogel/progress.h"

namespace hogel {

/// Films are made and read by the program ffmpeg, which is looked for in PATH when it is needed; nothing of it is
/// linked.

/// Whether that program is installed.
HOGEL_API bool can_make_films();

/// Makes a film (.mp4, .gif or .apng) of the pictures `frames` ("%06d.png") of a folder. `comment` is stored in it.
/// Throws Error(not_built_in) without ffmpeg, Error(cannot_write) where it fails.
HOGEL_API void make_film(const std::filesystem::path& film, const std::filesystem::path& folder,
                         const std::string& frames, double frames_a_second, const std::string& comment = {},
                         const Progress& progress = {});

}  // namespace hogel
