// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/ply.h"

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
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
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
    std::size_t at = 0;
    while (at < std::min(bytes.size(), max_size)) {
        const std::size_t end = bytes.find_first_of("\r\n", at);
        if (end == bytes.npos) break;
        const std::string_view line = bytes.substr(at, end - at);
        at = end + (bytes.substr(end, 2) == "\r\n" ? 2 : 1);
        const auto words = split(line);
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info" || words[0] == "ply") continue;
        if (words[0] == "end_header") {
            if (!has_format) reject_file(file, "no format in the header", "ascii or binary");
            header.size = at;
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

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool ends_line(char c) { return c == '\r' || c == '\n'; }

/// Removes the part of a text up to the first character for which `is_end` holds, and returns it. The searches of
/// std::string_view look up a list for each character, which takes longer than all other checks.
template <class IsEnd>
std::string_view take_until(std::string_view& text, const IsEnd& is_end) {
    const auto end = std::ranges::find_if(text, is_end);
    const std::string_view part = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    text.remove_prefix(part.size());
    return part;
}

}  // namespace

std::string_view ply::Words::next() {
    take_until(rest_, [](char c) { return !is_blank(c); });
    return take_until(rest_, is_blank);
}

namespace {

std::uint64_t read_count(std::string_view bytes, const Type& type, Format format) {
    std::array<unsigned char, 4> raw{};
    std::memcpy(raw.data(), bytes.data(), type.size);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < type.size; ++i)
        value = value << 8 | raw[format == Format::big_endian ? i : type.size - 1 - i];
    return value;  // a negative length becomes a huge one, which is refused as too long
}

/// Throws unless every element of binary data is inside the file.
void check_binary(const std::string& file, const Header& header, std::string_view data) {
    for (const Element& element : header.elements) {
        std::size_t fixed = 0;
        bool has_lists = false;
        for (const Property& property : element.properties) {
            has_lists = has_lists || property.count;
            fixed += property.count ? property.count->size : property.type.size;
        }
        const auto truncated = [&](std::size_t done) {
            reject_file(file, fmt::format("ends in element '{}' {} of {}", element.name, done, element.count),
                        "the data that the header promises");
        };
        // Elements without values have no bytes, yet assimp makes room for each.
        if (const std::size_t least = std::max<std::size_t>(fixed, 1); element.count > data.size() / least)
            truncated(data.size() / least);
        if (!has_lists) {
            data.remove_prefix(element.count * fixed);
            continue;
        }
        for (std::size_t i = 0; i < element.count; ++i)
            for (const Property& property : element.properties) {
                std::size_t size = property.type.size;
                if (property.count) {
                    if (data.size() < property.count->size) truncated(i);
                    const std::uint64_t n = read_count(data, *property.count, header.format);
                    data.remove_prefix(property.count->size);
                    if (n > data.size() / size) truncated(i);
                    size *= n;
                }
                if (data.size() < size) truncated(i);
                data.remove_prefix(size);
            }
    }
}

/// Throws unless a line of text has every value of its element, and as many for a list as it announces.
void check_values(const std::string& file, const Element& element, std::size_t number, std::string_view line) {
    Words words(line);
    const auto reject_line = [&](const std::string& what) {
        reject_file(file, fmt::format("element '{}' {}: {}", element.name, number, what),
                    "a line with all values that the header promises");
    };
    for (const Property& property : element.properties) {
        std::size_t values = 1;
        if (property.count) {
            const std::string_view word = words.next();
            const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), values);
            if (status != std::errc{} || end != word.data() + word.size() || values > words.bytes_left())
                reject_line(fmt::format("list length '{}'", one_line(std::string(word.substr(0, 40)))));
        }
        for (; values > 0; --values)
            if (words.next().empty()) reject_line("ends early");
    }
}

/// Throws unless text data has one line for each element.
void check_text(const std::string& file, const Header& header, std::string_view data) {
    const auto next_line = [&data] {
        std::string_view line;
        do {
            take_until(data, [](char c) { return !is_blank(c) && !ends_line(c); });
            line = take_until(data, ends_line);
        } while (line.starts_with("comment"));
        return line;
    };
    for (const Element& element : header.elements) {
        const auto missing = [&](std::size_t lines) {
            reject_file(file, fmt::format("has {} lines of data for element '{}'", lines, element.name),
                        fmt::format("one for each of the {} that the header promises", element.count));
        };
        if (element.count > data.size()) missing(0);
        if (element.properties.empty()) continue;
        for (std::size_t i = 0; i < element.count; ++i) {
            const std::string_view line = next_line();
            if (line.empty()) missing(i);
            check_values(file, element, i, line);
        }
    }
}

}  // namespace

void check_ply(const std::string& file, std::string_view bytes) {
    const Header header = parse_header(file, bytes);
    const std::string_view data = bytes.substr(header.size);
    if (header.format == Format::ascii)
        check_text(file, header, data);
    else
        check_binary(file, header, data);
}

std::vector<std::string> notes_of_ply(const std::string& file, std::string_view bytes) {
    std::vector<std::string> notes;
    for (const Element& element : parse_header(file, bytes).elements) {
        const auto has = [&](std::string_view name) {
            return std::ranges::any_of(element.properties, [&](const Property& p) { return p.name == name; });
        };
        if (element.name == "face" && has("red")) notes.push_back("colours of faces are left out");
        if (element.name == "face" && has("texcoord"))
            notes.push_back("texture coordinates of faces' corners (texcoord) are left out");
        if (element.count > 0 && (element.name == "edge" || element.name == "tristrips" || element.name == "material"))
            notes.push_back(fmt::format("{} elements '{}' are left out", element.count, element.name));
    }
    return notes;
}

}  // namespace hogel::scene::mesh_files
