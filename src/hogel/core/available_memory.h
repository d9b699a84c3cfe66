// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace hogel::core {

/// Bytes that this process can take without swapping: the least of the free memory of the machine, of what the limits
/// of the process leave (`ulimit -v` and `-d`), and of what its control groups leave (versions 1 and 2). Infinity if
/// the system says none of them.
/// @param root  the folder in which `proc` and `sys` are
double available_memory(const std::filesystem::path& root = "/");

}  // namespace hogel::core
