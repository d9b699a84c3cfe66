// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace hogel::core {

/// Returns the number of bytes that this process can allocate without swapping. This is the minimum of the free memory
/// of the machine, the remainder of the process limits (`ulimit -v`, `-d`), and the remainder of the control groups
/// (versions 1 and 2). Returns infinity if the system reports none of them.
/// @param root  parent folder of `proc` and `sys`
double available_memory(const std::filesystem::path& root = "/");

}  // namespace hogel::core
