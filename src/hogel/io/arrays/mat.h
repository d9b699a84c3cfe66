// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/io/arrays/named_arrays.h"

namespace hogel::io::arrays {

/// The arrays that a field may be in have two or three axes.
constexpr std::size_t field_axes = 3;

/// Which arrays are read with their numbers.
enum class Reads {
    all,
    parameters,  ///< small ones, which may be parameters; of others only what is known without their numbers
};

/// Reads the numeric arrays with two axes or more, up to `max_axes`, from a MAT file of version 5; if `only` is not
/// empty, those of these names and small ones, which may be parameters. Throws Error(bad_input).
std::vector<NumberArray> read_mat5(const std::filesystem::path& path, std::span<const unsigned char> bytes,
                                   std::span<const std::string> only = {}, std::size_t max_axes = field_axes,
                                   Reads reads = Reads::all);

/// As read_mat5(), for a MAT file of version 7.3.
std::vector<NumberArray> read_mat73(const std::filesystem::path& path, std::span<const std::string> only = {},
                                    std::size_t max_axes = field_axes, Reads reads = Reads::all);

/// The numeric arrays of a MAT file of either version without their numbers, of which little is read. Throws
/// Error(bad_input).
std::vector<NumberArray> mat_heads(const std::filesystem::path& path);
std::vector<NumberArray> mat5_heads(const std::filesystem::path& path);
std::vector<NumberArray> mat73_heads(const std::filesystem::path& path);

/// The array of this name, with any number of axes. Throws Error(bad_input).
NumberArray read_mat_array(const std::filesystem::path& path, const std::string& name);

/// Whether an array has one of the names, or is so small that it may be a parameter.
bool is_wanted(const std::string& name, std::uint64_t samples, std::span<const std::string> only);
/// Whether the numbers of an array of so many samples are read.
bool has_numbers(std::uint64_t samples, Reads reads);

}  // namespace hogel::io::arrays
