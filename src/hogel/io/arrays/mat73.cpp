// SPDX-License-Identifier: Apache-2.0
// MAT files of version 7.3: HDF5 files behind MATLAB's header of 512 bytes. Each array is a dataset of the root group
// with its axes reversed, because MATLAB stores columns first. Complex numbers are compounds {real, imag}; the
// attribute MATLAB_class names the class of the array.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/io/arrays/hdf5_v0.h"
#include "hogel/io/arrays/mat.h"

namespace hogel::io::arrays {
namespace {

std::vector<unsigned char> numbers_of(const std::vector<unsigned char>& elements, std::size_t element_bytes,
                                      const Hdf5V0Dataset::Member& member) {
    const std::size_t bytes = bytes_of(member.number), count = elements.size() / element_bytes;
    std::vector<unsigned char> numbers(count * bytes);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(&numbers[i * bytes], &elements[i * element_bytes + member.offset], bytes);
    return numbers;
}

bool is_complex(const Hdf5V0Dataset& dataset) {
    return dataset.element_bytes <= 16 && dataset.members.size() == 2 && dataset.members[0].name == "real" &&
           dataset.members[1].name == "imag";
}

// Texts, logical arrays and cells are also stored as whole numbers.
bool is_numeric(const Hdf5V0Dataset& dataset) {
    static constexpr const char* classes[] = {"double", "single", "int8",   "uint8", "int16",
                                              "uint16", "int32",  "uint32", "int64", "uint64"};
    const auto named = dataset.texts.find("MATLAB_class");
    if (named != dataset.texts.end() && std::ranges::find(classes, named->second) == std::end(classes)) return false;
    return is_complex(dataset) || (dataset.members.size() == 1 && dataset.members[0].name.empty());
}

bool is_read(const Hdf5V0Dataset& dataset) {
    return is_numeric(dataset) && dataset.shape.size() >= 2 && dataset.samples() > 0;
}

// What is known of an array before its numbers are read.
NumberArray head_of(const Hdf5V0Dataset& dataset) {
    NumberArray array;
    array.name = dataset.name;
    array.shape.assign(dataset.shape.rbegin(), dataset.shape.rend());
    array.by_columns = true;
    array.real_number = array.number_class = dataset.members[0].number;
    array.floating = !is_whole(array.real_number);
    array.count = dataset.samples();
    array.complex = is_complex(dataset);
    if (array.complex) array.imaginary_number = dataset.members[1].number;
    return array;
}

}  // namespace

std::vector<NumberArray> read_mat73(const std::filesystem::path& path, std::span<const std::string> only,
                                    std::size_t max_axes, Reads reads) {
    const Hdf5V0 file(path);
    std::vector<NumberArray> arrays;
    for (const Hdf5V0Dataset& dataset : file.datasets()) {
        if (!is_read(dataset) || dataset.shape.size() > max_axes || !is_wanted(dataset.name, dataset.samples(), only))
            continue;
        NumberArray array = head_of(dataset);
        if (!has_numbers(array, reads)) {
            arrays.push_back(std::move(array));
            continue;
        }
        std::vector<unsigned char> elements = file.read(dataset);
        if (array.complex) {
            array.real = numbers_of(elements, dataset.element_bytes, dataset.members[0]);
            array.imaginary = numbers_of(elements, dataset.element_bytes, dataset.members[1]);
        } else {
            array.real = std::move(elements);
        }
        arrays.push_back(std::move(array));
    }
    return arrays;
}

std::vector<NumberArray> mat73_heads(const std::filesystem::path& path) {
    std::vector<NumberArray> arrays;
    for (const Hdf5V0Dataset& dataset : Hdf5V0(path).datasets())
        if (is_read(dataset)) arrays.push_back(head_of(dataset));
    return arrays;
}

}  // namespace hogel::io::arrays
