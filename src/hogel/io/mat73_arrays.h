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
    std::vector<std::uint64_t> shape;     ///< two or more axes, none empty; the last one runs fastest
    std::vector<Number> numbers;          ///< types of an element's numbers: one, or real and imaginary part
    std::vector<unsigned char> elements;  ///< numbers interleaved; empty if not read

    std::uint64_t samples() const;  ///< saturates at 2^48
    std::size_t element_bytes() const;
};

/// Returns the numeric arrays in the root group of a MAT file of version 7.3 (HDF5 after MATLAB's header), by name. The
/// HDF5 library reads it in a child process, because it crashes on damaged structures, and these have no checksums.
/// Throws Error(bad_input); Error(not_built_in) in a build without HDF5.
/// @param wants_elements  whether to read the elements of an array
std::vector<Mat73Array> read_mat73_arrays(const std::filesystem::path& path,
                                          const std::function<bool(const Mat73Array&)>& wants_elements);

}  // namespace hogel::io
