// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace hogel::core {

/// Returns the path of a program found in PATH, or an empty string.
std::string find_program(const std::string& name);

/// Runs a program and waits for it. Its standard streams are /dev/null. Returns whether it exited with status 0. On a
/// stop request kills the program and throws Error(cancelled).
/// @param words  path of the program and its arguments
bool run_program(const std::vector<std::string>& words);

}  // namespace hogel::core
