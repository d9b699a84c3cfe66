// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hogel/array.h"
#include "hogel/files.h"

namespace hogel::io::arrays {

/// Types of numbers in a file, little-endian. `real` is a double.
enum class Number { int8, uint8, int16, uint16, int32, uint32, int64, uint64, half, single, real };
std::size_t bytes_of(Number number);
double number_at(Number number, const unsigned char* at);

/// Converts the numbers of a file, as described by ExternalField, to samples of a field.
class SampleConverter {
  public:
    /// Throws Error(usage) if real numbers are described as complex values, or complex ones as amplitudes or phases.
    SampleConverter(const std::filesystem::path& path, const ExternalField& what, Number number, bool complex);

    /// The sample for a real number, or for the two parts of a complex one. Throws Error(bad_input) if it is not
    /// finite.
    std::complex<float> operator()(double real, double imaginary) const;

  private:
    std::filesystem::path path_;
    ExternalField::Values values_;
    double sign_;     // sign of imaginary parts
    double radians_;  // radians per unit of a phase
};

std::unique_ptr<FieldSource> open_npy(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_mat(const std::filesystem::path& path, const ExternalField& what);
std::unique_ptr<FieldSource> open_picture_field(const std::filesystem::path& path, const ExternalField& what);

/// external_colours() of a NumPy array.
std::size_t npy_colours(const std::filesystem::path& path);

bool is_npy(std::span<const unsigned char> start);
bool is_mat(std::span<const unsigned char> start);

/// The grid of an array centred at x = y = 0. Throws Error(bad_input) for an empty array, and Error(usage) if `what` is
/// incomplete.
FieldGrid external_grid(const std::filesystem::path& path, const ExternalField& what, std::size_t width,
                        std::size_t height);

[[noreturn]] void fail_external(const std::filesystem::path& path, const std::string& why);

}  // namespace hogel::io::arrays
