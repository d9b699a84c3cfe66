// SPDX-License-Identifier: Apache-2.0
// MAT files of version 7.3. The axes are reversed, because MATLAB is column-major.
#include <cstring>

#include "hogel/io/arrays/mat.h"
#include "hogel/io/mat73_arrays.h"

namespace hogel::io::arrays {
namespace {

std::vector<unsigned char> numbers_of(const Mat73Array& array, std::size_t offset, Number number) {
    const std::size_t bytes = bytes_of(number), step = array.element_bytes(), count = array.elements.size() / step;
    std::vector<unsigned char> numbers(count * bytes);
    for (std::size_t i = 0; i < count; ++i) std::memcpy(&numbers[i * bytes], &array.elements[i * step + offset], bytes);
    return numbers;
}

NumberArray number_array(Mat73Array found) {
    NumberArray array;
    array.name = std::move(found.name);
    array.shape.assign(found.shape.rbegin(), found.shape.rend());
    array.by_columns = true;
    array.real_number = array.number_class = found.numbers[0];
    array.floating = !is_whole(array.real_number);
    array.count = found.samples();
    array.complex = found.numbers.size() == 2;
    if (!array.complex) {
        array.real = std::move(found.elements);
        return array;
    }
    array.imaginary_number = found.numbers[1];
    array.real = numbers_of(found, 0, array.real_number);
    array.imaginary = numbers_of(found, bytes_of(array.real_number), array.imaginary_number);
    return array;
}

}  // namespace

std::vector<NumberArray> read_mat73(const std::filesystem::path& path, std::span<const std::string> only,
                                    std::size_t max_axes, Reads reads) {
    const auto is_read = [&](const Mat73Array& found) {
        return found.shape.size() <= max_axes && is_wanted(found.name, found.samples(), only);
    };
    const auto wants_elements = [&](const Mat73Array& found) {
        return is_read(found) && has_numbers(found.samples(), reads);
    };
    std::vector<NumberArray> arrays;
    for (Mat73Array& found : read_mat73_arrays(path, wants_elements))
        if (is_read(found)) arrays.push_back(number_array(std::move(found)));
    return arrays;
}

std::vector<NumberArray> mat73_heads(const std::filesystem::path& path) {
    std::vector<NumberArray> arrays;
    for (Mat73Array& found : read_mat73_arrays(path, [](const Mat73Array&) { return false; }))
        arrays.push_back(number_array(std::move(found)));
    return arrays;
}

}  // namespace hogel::io::arrays
