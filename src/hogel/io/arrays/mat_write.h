// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

/// The bytes of a MAT file of version 5, which MATLAB from version 5 on, Octave and SciPy read: little-endian, not
/// compressed. Names are those of variables in MATLAB: a letter, then letters, digits and underscores.
class MatWriter {
  public:
    /// @param path  of the file, for messages
    explicit MatWriter(const std::filesystem::path& path);

    /// A double, or a row of them.
    void numbers(const std::string& name, std::span<const double> values);
    void text(const std::string& name, const std::string& value);
    /// An array of class single; the first index runs fastest, as in MATLAB. `imaginary` is empty for a real array.
    /// Throws Error(usage) for an array of more than 2 GiB, which the format does not hold.
    void array(const std::string& name, std::span<const std::size_t> shape, std::span<const float> real,
               std::span<const float> imaginary = {});

    /// All of an array of numbers but these, which are to follow the bytes, the first index fastest, and then zeros up
    /// to a multiple of eight; nothing else may follow. Throws as array() does.
    void begin_numbers(const std::string& name, std::span<const std::size_t> shape, Number number);

    const std::vector<unsigned char>& bytes() const { return bytes_; }

  private:
    void require_size(std::uint64_t bytes) const;
    std::size_t begin_array(const std::string& name, unsigned char kind, bool complex,
                            std::span<const std::size_t> shape);
    void end_array(std::size_t begin);
    void element(unsigned type, std::span<const unsigned char> data);

    std::filesystem::path path_;
    std::vector<unsigned char> bytes_;
};

}  // namespace hogel::io::arrays
