// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hogel/provenance.h"

namespace hogel::cli {

class Command;

/// Sets the parameters of a command to the values stored in a file. Parameters given on the command line, and those
/// that they exclude, keep their values. Throws Error(bad_input) if the file stores no command or another one.
/// @return names of the parameters that were set
std::vector<std::string> take_like(Command& command, const std::string& file);

/// Returns the run stored by `hogel make` in the report of a folder, or in a JSON file: report.json, or manifest.json
/// of `hogel print`; nothing for other paths.
std::optional<Metadata> run_of_make(const std::filesystem::path& path);

/// Returns the command line stored in a file's metadata, without its output: "hogel render pumpkin --hogels 64x64".
/// Returns an empty text if the entries contain no known command or not its input.
std::string command_line_of(const Metadata& entries);

}  // namespace hogel::cli
