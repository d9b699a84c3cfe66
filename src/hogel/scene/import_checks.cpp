#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hogel/core/error.h"
#include "hogel/scene/import_checks_internal.h"

namespace hogel {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 30;

std::string extension(const std::filesystem::path& path) {
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
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
    return line.empty() ? "cannot be read" : line;
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
    if (size > largest_file) reject_file(file, "more than 4 GiB", "a smaller mesh file");
}

}  // namespace hogel
