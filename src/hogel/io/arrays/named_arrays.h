// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

/// Position of a field, or of several colours, in an array: strides between neighbouring samples, in elements.
struct Planes {
    std::size_t height = 0, width = 0, colours = 1;
    std::size_t step_y = 0, step_x = 0, step_colour = 0;
    std::size_t step_pair = 0;  ///< stride from the first to the second of two real numbers per sample; 0: one number
};

/// Returns the planes of an array of rows and columns. Axes of extent 1 are ignored. An axis of 3 before or after rows
/// and columns (for complex numbers also of 2) holds the colours. An axis of 2 real numbers before or after all others
/// holds the parts of a sample. Throws Error(bad_input) for other shapes.
Planes planes_of(const std::filesystem::path& path, std::span<const std::size_t> shape, bool by_columns, bool complex);

/// An array from a file of several arrays, in memory.
struct NumberArray {
    std::string name;
    std::vector<std::size_t> shape;  ///< in the order of the program that wrote it: rows first
    bool by_columns = false;         ///< column-major: the first index runs fastest, as in MATLAB
    Number real_number = Number::real, imaginary_number = Number::real;
    bool floating = false;               ///< whether the program treats it as floating-point, however it is stored
    Number number_class = Number::real;  ///< type of the numbers in the program; set for MAT files
    std::size_t count = 0;               ///< number of samples, read or not
    bool complex = false;
    std::vector<unsigned char> real, imaginary;  ///< empty if the numbers were not read

    std::size_t samples() const { return count; }
    double real_at(std::size_t i) const { return number_at(real_number, &real[i * bytes_of(real_number)]); }
    double imaginary_at(std::size_t i) const {
        return number_at(imaginary_number, &imaginary[i * bytes_of(imaginary_number)]);
    }
    Number kind() const { return floating ? Number::real : real_number; }
};

/// Opens the field in the arrays of a file: description.variable ("field", or "re,im" for two), otherwise the only
/// candidate, or the pair named real and imaginary, or amplitude and phase. Throws as open_external_field() does.
std::unique_ptr<FieldSource> open_arrays(const std::filesystem::path& path, const ExternalField& description,
                                         const std::vector<NumberArray>& arrays);
ExternalFacts facts_of_arrays(const std::filesystem::path& path, const ExternalField& description,
                              const std::vector<NumberArray>& arrays, const std::string& format);

/// Name of an array or a channel. Parts of one field are in the same group.
struct PartName {
    std::string name, group;
};
/// Indices of two names that differ only in the words for real and imaginary part, or for amplitude and phase.
struct PartPair {
    std::size_t first = 0, second = 0;
    Content content = Content::complex;
};
/// Returns up to `most` such pairs. The time is proportional to the numbers of names and pairs.
std::vector<PartPair> pairs_of_parts(std::span<const PartName> names, std::size_t most);

/// Sets a wavelength or a pitch from a variable with such a name: "pitch", "lambda", "wav_um".
void take_parameter(const std::string& name, std::span<const double> values, ExternalFacts& facts);

}  // namespace hogel::io::arrays
