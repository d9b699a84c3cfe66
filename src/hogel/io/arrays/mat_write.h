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

/// Writer of an uncompressed little-endian MAT file of version 5, as read by MATLAB 5 and later, Octave and SciPy.
/// Names are MATLAB variable names: a letter, then letters, digits and underscores.
class MatWriter {
  public:
    explicit MatWriter(const std::filesystem::path& path);

    /// Adds a double, or a row of doubles.
    void numbers(const std::string& name, std::span<const double> values);
    void text(const std::string& name, const std::string& value);
    /// Adds an array of class single; the first index runs fastest, as in MATLAB. `imaginary` is empty for a real
    /// array. Throws Error(usage) for an array of more than 2 GiB, the limit of the format.
    void array(const std::string& name, std::span<const std::size_t> shape, std::span<const float> real,
               std::span<const float> imaginary = {});

    /// Adds the header of an array of numbers. The caller appends the numbers to bytes(), first index fastest, and
    /// zeros up to a multiple of eight; nothing else may follow. Throws as array() does.
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
