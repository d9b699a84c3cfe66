// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace hogel::core {

/// The path of a program that is found by PATH; empty if there is none.
std::string find_program(const std::string& name);

/// Runs a program, by its path and arguments, with nothing to read and nowhere to write but to files, and waits for it.
/// Returns whether it ended well. When the work of this thread is to stop, the program is ended and Error(cancelled)
/// thrown.
bool run_program(const std::vector<std::string>& words);

}  // namespace hogel::core
