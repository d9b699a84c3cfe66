// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/stl.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "hogel/scene/mesh_files/checks.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;  // of binary files; the last 4 bytes are the count

/// Binary files may begin with "solid" too, but not with "solid" and a facet as text.
bool is_text(std::string_view bytes) {
    const std::string_view start = bytes.substr(0, 4096);
    return start.find('\0') == start.npos && start.find("solid") != start.npos &&
           (start.find("facet") != start.npos || start.find("endsolid") != start.npos);
}

std::uint64_t announced_triangles(std::string_view bytes) {
    std::uint64_t count = 0;
    for (std::size_t i = 4; i-- > 0;) count = count << 8 | static_cast<unsigned char>(bytes[header_size - 4 + i]);
    return count;
}

}  // namespace

std::string with_counted_triangles(const std::string& file, std::string bytes, std::vector<std::string>& notes) {
    if (bytes.size() < header_size || is_text(bytes)) return bytes;
    const std::uint64_t announced = announced_triangles(bytes),
                        complete_triangles = (bytes.size() - header_size) / triangle_size,
                        extra_bytes = (bytes.size() - header_size) % triangle_size;
    constexpr std::uint64_t unknown = 0xFFFFFFFF;  // written by programs that do not update the count
    if (announced > complete_triangles && announced != unknown)
        reject_file(file, fmt::format("announces {} triangles and holds {}", announced, complete_triangles),
                    "an undamaged STL file");
    const std::uint64_t count = extra_bytes == 0 || announced == unknown ? complete_triangles : announced;
    if (count != announced)
        notes.push_back(fmt::format("it announces {} triangles: all {} that it holds are shown", announced, count));
    if (const std::size_t extra = bytes.size() - header_size - count * triangle_size; extra > 0) {
        notes.push_back(fmt::format("{} bytes behind its last triangle are left out", extra));
        bytes.resize(header_size + count * triangle_size);
    }
    for (std::size_t i = 0; i < 4; ++i) bytes[header_size - 4 + i] = static_cast<char>(count >> (8 * i) & 0xFF);
    return bytes;
}

}  // namespace hogel::scene::mesh_files
