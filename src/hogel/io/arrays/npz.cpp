// SPDX-License-Identifier: Apache-2.0
// NPZ files of NumPy: a ZIP archive of NPY files, one per array, stored or deflated.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/core/stop_scope.h"
#include "hogel/io/arrays/named_arrays.h"
#include "hogel/io/arrays/npy.h"
#include "hogel/io/arrays/zip.h"

namespace hogel::io::arrays {
namespace {

// Returns the array of a header, in native byte order, with real and imaginary parts separated.
NumberArray array_of(const std::string& name, const NpyHeader& header, std::span<const unsigned char> bytes) {
    NumberArray array;
    array.name = name;
    array.shape = header.shape;
    array.by_columns = header.by_columns;
    array.real_number = array.imaginary_number = header.number;
    const std::size_t number = bytes_of(header.number), sample = header.bytes_of_sample();
    std::size_t count = 1;
    for (const std::size_t extent : header.shape) count *= extent;
    array.count = count;
    array.complex = header.complex;
    array.real.resize(count * number);
    if (header.complex) array.imaginary.resize(count * number);
    const auto copy = [&](const unsigned char* from, unsigned char* to) {
        std::memcpy(to, from, number);
        if (header.big_endian) std::reverse(to, to + number);
    };
    for (std::size_t i = 0; i < count; ++i) {
        if (i % bytes_between_checks == 0) core::throw_if_stopped();
        const unsigned char* sample_bytes = &bytes[header.begin + i * sample];
        copy(sample_bytes, &array.real[i * number]);
        if (header.complex) copy(sample_bytes + number, &array.imaginary[i * number]);
    }
    return array;
}

// Returns all arrays of numbers; skips empty arrays, texts and objects.
std::vector<NumberArray> read_npz(const std::filesystem::path& path) {
    const std::vector<unsigned char> archive = all_bytes(path);
    std::vector<NumberArray> arrays;
    for (const ZipEntry& entry : read_zip(path, archive)) {
        constexpr std::string_view ending = ".npy";
        if (!entry.name.ends_with(ending)) continue;
        const std::vector<unsigned char> bytes = unpack(path, entry);
        if (!is_npy(bytes)) fail_external(path, fmt::format("its file '{}' is no NumPy array", entry.name));
        if (!npy_holds_numbers(path, bytes)) continue;
        const NpyHeader header = parse_npy_header(path, bytes, bytes.size());
        if (std::ranges::count(header.shape, 0u) > 0) continue;
        arrays.push_back(array_of(entry.name.substr(0, entry.name.size() - ending.size()), header, bytes));
    }
    return arrays;
}

}  // namespace

bool is_zip(std::span<const unsigned char> start) {
    return start.size() >= 4 && std::memcmp(start.data(), "PK\3\4", 4) == 0;
}

std::unique_ptr<FieldSource> open_npz(const std::filesystem::path& path, const ExternalField& description) {
    return open_arrays(path, description, read_npz(path));
}

ExternalFacts npz_facts(const std::filesystem::path& path, const ExternalField& description) {
    return facts_of_arrays(path, description, read_npz(path), "npz");
}

}  // namespace hogel::io::arrays
