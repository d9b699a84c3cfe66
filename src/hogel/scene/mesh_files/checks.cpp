// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "hogel/error.h"
#include "hogel/scene/mesh_files/checks.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::uintmax_t max_file = std::uintmax_t{4} << 30;

std::string extension(const std::filesystem::path& path) {
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

std::string read_file(const std::filesystem::path& path, std::uintmax_t size) {
    std::string bytes(size, '\0');
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
        reject_file(path.string(), "cannot be read", "a readable mesh file");
    return bytes;
}

}  // namespace

void reject_file(const std::string& file, const std::string& what, const std::string& expected) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}; expected {}", file, what, expected));
}

std::string one_line(const std::string& message) {
    constexpr std::size_t longest = 200;
    std::string line = message.substr(0, longest);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~') c = ' ';
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

bool is_gltf(const std::filesystem::path& path) {
    const std::string ext = extension(path);
    return ext == ".gltf" || ext == ".glb" || ext == ".vrm";
}

void check_mesh_file(const std::filesystem::path& path) {
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
    // assimp chooses its reader both by the first bytes and by the name.
    char magic[4] = {};
    std::ifstream(path, std::ios::binary).read(magic, sizeof magic);
    const std::string_view start(magic, sizeof magic);
    if (extension(path) == ".ply" || start.starts_with("ply") || start.starts_with("PLY"))
        check_ply(file, read_file(path, size));
    else if (is_gltf(path) || start == "glTF")
        check_gltf(file, read_file(path, size));
}

}  // namespace hogel::scene::mesh_files
