// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hogel/io/number.h"

namespace hogel::io {

/// A numeric array of a MAT file of version 7.3.
struct Mat73Array {
    std::string name;
    std::vector<std::uint64_t> shape;     ///< two axes or more, none empty; the last one fastest
    std::vector<Number> numbers;          ///< of an element: one, or real and imaginary part
    std::vector<unsigned char> elements;  ///< with their numbers side by side; empty where they were not read

    std::uint64_t samples() const;  ///< 2^48 for any that are more
    std::size_t element_bytes() const;
};

/// The numeric arrays in the root group of a MAT file of version 7.3, which is an HDF5 file behind MATLAB's header, by
/// name. The HDF5 library reads it in a child process: it crashes on damaged structures, and these have no checksums.
/// @param wants_elements  tells for an array whether its elements are read
/// Throws Error(bad_input); Error(not_built_in) in a build without HDF5.
std::vector<Mat73Array> read_mat73_arrays(const std::filesystem::path& path,
                                          const std::function<bool(const Mat73Array&)>& wants_elements);

}  // namespace hogel::io
