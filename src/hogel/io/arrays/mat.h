// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/io/arrays/named_arrays.h"

namespace hogel::io::arrays {

/// Reads the numeric arrays with two or three axes from a MAT file of version 5; if `only` is not empty, those of these
/// names and small ones, which may be parameters. Throws Error(bad_input).
std::vector<NumberArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                   std::span<const std::string> only = {});

/// As read_mat5(), for a MAT file of version 7.3.
std::vector<NumberArray> read_mat73(const std::filesystem::path& path, std::span<const std::string> only = {});

/// Whether an array has one of the names, or is so small that it may be a parameter.
bool is_wanted(const std::string& name, std::uint64_t samples, std::span<const std::string> only);

}  // namespace hogel::io::arrays
