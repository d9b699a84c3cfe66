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

/// Returns the modulators of hogel's own profiles, of *.json in a folder, or of hogel's and the user's, by name. A
/// profile with an error is a Modulator with a `fault`. A missing folder has none.
std::vector<Modulator> own_profiles();
std::vector<Modulator> profiles_in(const std::filesystem::path& folder);
std::vector<Modulator> all_profiles();

/// Throws Error(usage) if a device of this name is no modulator.
/// @param known  names of the modulators
void require_modulator(const std::string& name, const std::vector<std::string>& known);

}  // namespace hogel::patterns
