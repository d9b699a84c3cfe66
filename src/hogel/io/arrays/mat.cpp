// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/mat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hogel/core/raw_file.h"

namespace hogel::io::arrays {
namespace {

// Returns whether the version in the header, before the byte-order mark, is 7.3.
bool is_version_73(const std::filesystem::path& path) {
    const core::RawFile file(path, core::RawFile::Mode::read, path);
    unsigned char version[4];
    file.read(124, version, sizeof version);
    return version[1] == 2 && version[2] == 'I' && version[3] == 'M';
}

// Returns the arrays that may hold a field of this name.
std::vector<NumberArray> arrays_of(const std::filesystem::path& path, const std::string& variable, Reads reads) {
    std::vector<std::string> only;
    if (!variable.empty()) {
        const std::size_t comma = variable.find(',');
        only.push_back(variable.substr(0, comma));
        if (comma != std::string::npos) only.push_back(variable.substr(comma + 1));
    }
    return is_version_73(path) ? read_mat73(path, only, field_axes, reads)
                               : read_mat5(path, all_bytes(path), only, field_axes, reads);
}

constexpr std::uint64_t max_parameter = 3;  // samples

}  // namespace

bool is_wanted(const std::string& name, std::uint64_t samples, std::span<const std::string> only) {
    return only.empty() || samples <= max_parameter || std::ranges::find(only, name) != only.end();
}

bool has_numbers(std::uint64_t samples, Reads reads) { return reads == Reads::all || samples <= max_parameter; }

bool is_mat(std::span<const unsigned char> start) {
    return start.size() >= 128 && std::memcmp(start.data(), "MATLAB ", 7) == 0;
}

std::vector<NumberArray> mat_heads(const std::filesystem::path& path) {
    return is_version_73(path) ? mat73_heads(path) : mat5_heads(path);
}

NumberArray read_mat_array(const std::filesystem::path& path, const std::string& name) {
    constexpr std::size_t any = 32;
    const std::string only[] = {name};
    std::vector<NumberArray> arrays =
        is_version_73(path) ? read_mat73(path, only, any) : read_mat5(path, all_bytes(path), only, any);
    const auto found = std::ranges::find(arrays, name, &NumberArray::name);
    if (found == arrays.end()) fail_external(path, fmt::format("it has no array '{}' of numbers", name));
    return std::move(*found);
}

std::unique_ptr<FieldSource> open_mat(const std::filesystem::path& path, const ExternalField& description) {
    return open_arrays(path, description, arrays_of(path, description.variable, Reads::all));
}

ExternalFacts mat_facts(const std::filesystem::path& path, const ExternalField& description) {
    return facts_of_arrays(path, description, arrays_of(path, description.variable, Reads::parameters), "mat");
}

}  // namespace hogel::io::arrays
