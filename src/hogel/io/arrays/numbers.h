// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hogel/array.h"
#include "hogel/files.h"

namespace hogel::io::arrays {

/// How numbers lie in a file, little-endian.
enum class Number { int8, uint8, int16, uint16, int32, uint32, int64, uint64, single, real };
std::size_t bytes_of(Number number);
double number_at(Number number, const unsigned char* at);

/// Makes field samples of the numbers of a file.
class Meaning {
  public:
    /// Throws Error(usage) where real numbers were not said to be amplitudes or phases, or complex ones were.
    Meaning(const std::filesystem::path& path, const ExternalField& what, Number number, bool complex);

    /// Throws Error(bad_input) for a number that is not finite.
    std::complex<float> operator()(double real, double imaginary) const;

  private:
    std::filesystem::path path_;
    ExternalField::RayValues values_;
    double sign_, radians_;
};

std::unique_ptr<FieldSource> open_npy(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_mat(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& what);

bool is_npy(std::span<const unsigned char> start);
bool is_mat(std::span<const unsigned char> start);

/// A grid of so many samples around x = y = 0. Throws Error(bad_input) where there are none.
FieldGrid external_grid(const std::filesystem::path& path, const ExternalField& what, std::size_t width,
                        std::size_t height);

[[noreturn]] void fail_external(const std::filesystem::path& path, const std::string& why);

}  // namespace hogel::io::arrays
