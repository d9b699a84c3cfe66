// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/pattern.h"

namespace hogel::patterns {

/// Reads the JSON of a device profile. Throws Error(bad_input), with the file, the member and what was expected.
/// @param name  name of the device: the file's, without its extension
/// @param file  name for messages
Modulator read_profile(const std::string& name, std::string_view text, const std::string& file);

/// Returns hogel's own profiles, or those of *.json in a folder, by name. A profile with an error is a Modulator with a
/// `fault`. A missing folder has none.
std::vector<Modulator> own_profiles();
std::vector<Modulator> profiles_in(const std::filesystem::path& folder);

/// Returns the folder of the user's profiles, or an empty path without a home.
std::filesystem::path user_profiles();

}  // namespace hogel::patterns
