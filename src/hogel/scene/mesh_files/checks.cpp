// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "hogel/core/lower_case.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"
#include "hogel/printable.h"
#include "hogel/scene/mesh_files/checks.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::uintmax_t max_file = std::uintmax_t{4} << 30;

}  // namespace

void reject_file(const std::string& file, const std::string& what, const std::string& expected) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}; expected {}", file, what, expected));
}

std::string one_line(const std::string& message) {
    std::string line = printable(message);
    while (line.ends_with(' ')) line.pop_back();
    return line;
}

bool has_extension(const std::filesystem::path& path, std::initializer_list<std::string_view> extensions) {
    return std::find(extensions.begin(), extensions.end(), core::lower_case_extension(path)) != extensions.end();
}

bool is_gltf(const std::filesystem::path& path) { return has_extension(path, {".gltf", ".glb", ".vrm"}); }

bool starts_like_ply(std::string_view bytes) { return core::lower_case(std::string(bytes.substr(0, 3))) == "ply"; }

bool starts_with_mark(std::string_view bytes) { return bytes.starts_with("\xEF\xBB\xBF"); }

std::string read_file(const std::filesystem::path& path, std::uintmax_t size, const std::string& file) {
    constexpr std::size_t bytes_between_checks = std::size_t{16} << 20;
    std::string bytes(size, '\0');
    std::ifstream stream(path, std::ios::binary);
    for (std::size_t offset = 0; offset < size; offset += bytes_between_checks) {
        core::throw_if_stopped();
        if (!stream.read(bytes.data() + offset,
                         static_cast<std::streamsize>(std::min(bytes_between_checks, size - offset))))
            reject_file(file, fmt::format("{} cannot be read", one_line(path.filename().string())), "a readable file");
    }
    if (starts_with_mark(bytes)) bytes.erase(0, 3);
    return bytes;
}

std::uintmax_t check_regular_file(const std::filesystem::path& path) {
    const std::string file = path.string();
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) reject_file(file, "no such file", "a mesh file");
    if (std::filesystem::is_directory(status)) reject_file(file, "a folder", "a mesh file");
    if (!std::filesystem::is_regular_file(status)) reject_file(file, "not a regular file", "a mesh file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) reject_file(file, error.message(), "a readable mesh file");
    if (size == 0) reject_file(file, "empty", "a mesh file");
    if (size > max_file) reject_file(file, "more than 4 GiB", "a smaller mesh file");
    return size;
}

}  // namespace hogel::scene::mesh_files
