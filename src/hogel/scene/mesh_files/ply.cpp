// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/checks.h"

namespace hogel::scene::mesh_files {

using namespace ply;

namespace {

constexpr std::array types{Type{"char", "int8", 1, true},      Type{"uchar", "uint8", 1, true},
                           Type{"short", "int16", 2, true},    Type{"ushort", "uint16", 2, true},
                           Type{"int", "int32", 4, true},      Type{"uint", "uint32", 4, true},
                           Type{"float", "float32", 4, false}, Type{"double", "float64", 8, false}};

[[noreturn]] void reject(const std::string& file, std::string_view line, const char* expected) {
    reject_file(file, fmt::format("header line '{}'", one_line(std::string(line))), expected);
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t position = 0; (position = line.find_first_not_of(" \t\r", position)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t\r", position), line.size());
        words.push_back(line.substr(position, end - position));
        position = end;
    }
    return words;
}

Type parse_type(const std::string& file, std::string_view line, std::string_view name) {
    for (const Type& type : types)
        if (name == type.name || name == type.other_name) return type;
    reject(file, line, "a type such as uchar, int or float");
}

void parse_property(const std::string& file, std::string_view line, const std::vector<std::string_view>& words,
                    Header& header) {
    if (header.elements.empty()) reject(file, line, "an element before its properties");
    auto& properties = header.elements.back().properties;
    if (words.size() == 3) {
        properties.push_back({std::string(words[2]), parse_type(file, line, words[1]), std::nullopt});
    } else if (words.size() == 5 && words[1] == "list") {
        const Type count = parse_type(file, line, words[2]);
        if (!count.is_integer) reject(file, line, "a list length of integer type");
        properties.push_back({std::string(words[4]), parse_type(file, line, words[3]), count});
    } else {
        reject(file, line, "'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
}

Format parse_format(const std::string& file, std::string_view line, std::string_view name) {
    if (name == "ascii") return Format::ascii;
    if (name == "binary_little_endian") return Format::little_endian;
    if (name == "binary_big_endian") return Format::big_endian;
    reject(file, line, "ascii, binary_little_endian or binary_big_endian");
}

Element parse_element(const std::string& file, std::string_view line, const std::vector<std::string_view>& words) {
    Element element{one_line(std::string(words[1])), 0, {}};
    const auto [rest, status] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (status != std::errc{} || rest != words[2].data() + words[2].size()) reject(file, line, "a number of elements");
    return element;
}

}  // namespace

Header ply::parse_header(const std::string& file, std::string_view bytes) {
    constexpr std::size_t max_size = std::size_t{1} << 20;
    Header header;
    bool has_format = false;
    std::size_t position = 0;
    while (position < std::min(bytes.size(), max_size)) {
        const std::size_t end = bytes.find_first_of("\r\n", position);
        if (end == bytes.npos) break;
        const std::string_view line = bytes.substr(position, end - position);
        position = end + (bytes.substr(end, 2) == "\r\n" ? 2 : 1);
        const auto words = split(line);
        if (words.size() > 2 && words[0] == "comment" && words[1] == "TextureFile")
            header.textures.emplace_back(line.substr(static_cast<std::size_t>(words[2].data() - line.data())));
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info" || words[0] == "ply") continue;
        if (words[0] == "end_header") {
            if (!has_format) reject_file(file, "no format in the header", "ascii or binary");
            header.size = position;
            return header;
        }
        if (words[0] == "format" && words.size() == 3) {
            has_format = true;
            header.format = parse_format(file, line, words[1]);
        } else if (words[0] == "element" && words.size() == 3) {
            header.elements.push_back(parse_element(file, line, words));
        } else if (words[0] == "property") {
            parse_property(file, line, words, header);
        } else {
            reject(file, line, "format, comment, element, property or end_header");
        }
    }
    reject_file(file, "no end_header", "a PLY file");
}

}  // namespace hogel::scene::mesh_files
