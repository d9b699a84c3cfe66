// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hogel/provenance.h"

namespace hogel::cli {

class Command;

/// Sets the parameters of a command to the values that made a file. The given ones, and what these exclude, stay as
/// they are. Throws Error(bad_input) for a file that does not say what made it, or that another command made.
/// @return the names of the parameters that were set
std::vector<std::string> take_like(Command& command, const std::string& file);

/// What `hogel make` says of its run in the report of this folder, or in this report.json; nothing for other paths.
std::optional<Metadata> run_of_make(const std::filesystem::path& path);

/// The command line that made a file which stores these entries, without its output: "hogel render pumpkin --hogels
/// 64x64". Empty where they name no command.
std::string command_line_of(const Metadata& entries);

}  // namespace hogel::cli
