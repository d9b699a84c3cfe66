// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstring>

#include "hogel/core/raw_file.h"
#include "hogel/io/arrays/mat.h"

namespace hogel::io::arrays {
namespace {

std::vector<unsigned char> all_bytes(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    std::vector<unsigned char> bytes(file.size());
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

// Whether the version in the header, which precedes the byte-order mark, is 7.3.
bool is_version_73(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    unsigned char version[4];
    file.read(124, version, sizeof version);
    return version[1] == 2 && version[2] == 'I' && version[3] == 'M';
}

// The only array. Throws Error(bad_input) if there is none or more than one.
const MatArray& chosen(const std::filesystem::path& path, const std::vector<MatArray>& arrays,
                       const std::string& name) {
    if (arrays.size() == 1) return arrays.front();
    if (arrays.empty())
        fail_external(path, name.empty() ? "it holds no array of numbers with two axes"
                                         : fmt::format("it holds no array '{}' of numbers with two axes", name));
    std::string names;
    for (const MatArray& array : arrays) names += fmt::format("{}{}", names.empty() ? "" : ", ", array.name);
    fail_external(path, fmt::format("it holds several arrays; which one is meant of {}?", names));
}

}  // namespace

bool is_mat(std::span<const unsigned char> start) {
    return start.size() >= 128 && std::memcmp(start.data(), "MATLAB ", 7) == 0;
}

std::unique_ptr<FieldSource> open_mat(const std::filesystem::path& path, const ExternalField& what) {
    const std::vector<MatArray> arrays =
        is_version_73(path) ? read_mat73(path, what.variable) : read_mat5(path, all_bytes(path), what.variable);
    const MatArray& array = chosen(path, arrays, what.variable);
    const bool complex = !array.imaginary.empty();
    const SampleConverter convert(path, what, array.floating ? Number::real : array.real_number, complex);
    auto field = std::make_unique<Field>(external_grid(path, what, array.width, array.height));
    const std::size_t real_bytes = bytes_of(array.real_number), imaginary_bytes = bytes_of(array.imaginary_number);
    for (std::size_t x = 0; x < array.width; ++x)
        for (std::size_t y = 0; y < array.height; ++y) {
            const std::size_t i = x * array.height + y;
            const double imaginary =
                complex ? number_at(array.imaginary_number, &array.imaginary[i * imaginary_bytes]) : 0;
            field->samples(y, x) = convert(number_at(array.real_number, &array.real[i * real_bytes]), imaginary);
        }
    return field;
}

}  // namespace hogel::io::arrays
