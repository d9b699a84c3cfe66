// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hogel::scene {

/// Resolves an untrusted relative path or URI to a regular file in the folder or below, following symbolic links. Tries
/// the name, then URI decoding ("my%20wood.png"), then other case. Returns nothing if there is no such file.
/// @param folder  canonical
std::optional<std::filesystem::path> find_in_folder(const std::filesystem::path& folder, const std::string& name);

}  // namespace hogel::scene
