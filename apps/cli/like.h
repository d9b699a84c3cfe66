// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace hogel::cli {

class Command;

/// Sets the parameters of a command to those that made a file, but for those that are given and those that these
/// exclude. Throws Error(bad_input) for a file that does not say what made it, or that another command made.
void take_like(Command& command, const std::string& file);

}  // namespace hogel::cli
