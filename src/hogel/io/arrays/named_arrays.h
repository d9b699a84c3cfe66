// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hogel/io/arrays/numbers.h"

namespace hogel::io::arrays {

/// Where the samples of one field, or of several colours, are in an array: the steps from a sample to its neighbours.
struct Planes {
    std::size_t height = 0, width = 0, colours = 1;
    std::size_t step_y = 0, step_x = 0, step_colour = 0;
    std::size_t step_pair = 0;  ///< from the first to the second of two real numbers a sample; 0: there is one
};

/// The planes of an array of two axes, rows and columns. Axes of one are left out; an axis of three before or after
/// them, of complex numbers also of two, has the colours; one of two real numbers before or after all of them has the
/// parts of samples. Throws Error(bad_input) for others.
Planes planes_of(const std::filesystem::path& path, std::span<const std::size_t> shape, bool by_columns, bool complex);

/// An array of a file of several, in memory.
struct NumberArray {
    std::string name;
    std::vector<std::size_t> shape;  ///< as its program writes it: rows first
    bool by_columns = false;         ///< whether the first index runs fastest, as in MATLAB
    Number real_number = Number::real, imaginary_number = Number::real;
    bool floating = false;  ///< whether its program takes it for floating-point numbers however they are stored
    Number number_class = Number::real;          ///< what its program takes the numbers for; filled for MAT files
    std::size_t count = 0;                       ///< of samples, whether they were read or not
    bool complex = false;                        ///< whether samples have imaginary parts
    std::vector<unsigned char> real, imaginary;  ///< empty where numbers were not read

    std::size_t samples() const { return count; }
    double real_at(std::size_t i) const { return number_at(real_number, &real[i * bytes_of(real_number)]); }
    double imaginary_at(std::size_t i) const {
        return number_at(imaginary_number, &imaginary[i * bytes_of(imaginary_number)]);
    }
    Number kind() const { return floating ? Number::real : real_number; }
};

/// The field in the arrays of a file: the one that what.variable names ("field", or "re,im" for two), else the only one
/// that can be one, or the two whose names say that they are parts: real and imaginary, or amplitude and phase. Throws
/// as open_external_field() does.
std::unique_ptr<FieldSource> open_arrays(const std::filesystem::path& path, const ExternalField& what,
                                         const std::vector<NumberArray>& arrays);
ExternalFacts facts_of_arrays(const std::filesystem::path& path, const ExternalField& what,
                              const std::vector<NumberArray>& arrays, const std::string& format);

/// A name of an array or a channel. Parts of a field are of the same group.
struct PartName {
    std::string name, group;
};
/// Indices of two names that differ in the words for real and imaginary parts, or for amplitude and phase.
struct PartPair {
    std::size_t first = 0, second = 0;
    Content content = Content::complex;
};
/// The pairs among names, by their indices; no more than `most` of them. Takes time in proportion to names and pairs.
std::vector<PartPair> pairs_of_parts(std::span<const PartName> names, std::size_t most);

/// Takes a wavelength or a pitch from a variable of that name, if it is one: "pitch", "lambda", "wav_um".
void take_parameter(const std::string& name, std::span<const double> values, ExternalFacts& facts);

}  // namespace hogel::io::arrays
