// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/io/arrays/named_arrays.h"

namespace hogel::io::arrays {

/// Maximum number of axes of an array that holds a field.
constexpr std::size_t field_axes = 3;

/// Arrays to read with their numbers.
enum class Reads {
    all,
    parameters,  ///< only small arrays, which may be parameters; others without numbers
};

/// Reads the numeric arrays with two to `max_axes` axes from a MAT file of version 5. If `only` is not empty, reads the
/// arrays of these names and small ones, which may be parameters. Throws Error(bad_input).
std::vector<NumberArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                   std::span<const std::string> only = {}, std::size_t max_axes = field_axes,
                                   Reads reads = Reads::all);

/// As read_mat5(), for a MAT file of version 7.3.
std::vector<NumberArray> read_mat73(const std::filesystem::path& path, std::span<const std::string> only = {},
                                    std::size_t max_axes = field_axes, Reads reads = Reads::all);

/// Returns the numeric arrays of a MAT file without numbers, reading little. Throws Error(bad_input).
std::vector<NumberArray> mat_heads(const std::filesystem::path& path);
std::vector<NumberArray> mat5_heads(const std::filesystem::path& path);
std::vector<NumberArray> mat73_heads(const std::filesystem::path& path);

/// Reads the array of this name, with any number of axes. Throws Error(bad_input).
NumberArray read_mat_array(const std::filesystem::path& path, const std::string& name);

/// Returns whether an array has one of the names, or is small enough to be a parameter.
bool is_wanted(const std::string& name, std::uint64_t samples, std::span<const std::string> only);
/// Returns whether the numbers of an array with this number of samples are read.
bool has_numbers(std::uint64_t samples, Reads reads);

}  // namespace hogel::io::arrays
