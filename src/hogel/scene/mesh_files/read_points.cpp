// SPDX-License-Identifier: Apache-2.0
// Point clouds: PLY files without faces, and texts of coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "hogel/image.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/ply.h"
#include "hogel/scene/mesh_files/points.h"

namespace hogel::scene::mesh_files {

using namespace ply;

namespace {

/// Where the values of a point are in its element: the numbers of the properties; none for one that is missing.
struct Columns {
    std::array<std::optional<std::size_t>, 3> position, normal, color;

    explicit Columns(const Element& element) {
        const auto find = [&](std::initializer_list<std::string_view> names) -> std::optional<std::size_t> {
            for (std::size_t i = 0; i < element.properties.size(); ++i)
                if (std::ranges::count(names, element.properties[i].name) > 0 && !element.properties[i].count) return i;
            return std::nullopt;
        };
        position = {find({"x"}), find({"y"}), find({"z"})};
        normal = {find({"nx", "normal_x"}), find({"ny", "normal_y"}), find({"nz", "normal_z"})};
        color = {find({"red", "r", "diffuse_red"}), find({"green", "g", "diffuse_green"}),
                 find({"blue", "b", "diffuse_blue"})};
    }
    static bool has(const std::array<std::optional<std::size_t>, 3>& columns) {
        return columns[0] && columns[1] && columns[2];
    }
};

double binary_value(const char* from, const Type& type, Format format) {
    std::array<char, 8> raw{};
    std::copy_n(from, type.size, raw.begin());
    if (format == Format::big_endian) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(type.size));
    const auto as = [&]<class T>(T value) {
        std::memcpy(&value, raw.data(), sizeof value);
        return static_cast<double>(value);
    };
    if (!type.is_integer) return type.size == 4 ? as(float{}) : as(double{});
    const bool is_unsigned = type.name.starts_with('u');
    if (type.size == 1) return is_unsigned ? as(std::uint8_t{}) : as(std::int8_t{});
    if (type.size == 2) return is_unsigned ? as(std::uint16_t{}) : as(std::int16_t{});
    return is_unsigned ? as(std::uint32_t{}) : as(std::int32_t{});
}

/// A display value as linear light; whole numbers as shares of their largest.
float light_of(double value, const Type& type) {
    const double largest = !type.is_integer ? 1 : type.size == 1 ? 255 : 65535;
    return srgb_decode(static_cast<float>(value / largest));
}

void add_point(const std::vector<double>& values, const Columns& columns, const Element& element, Points& points) {
    const auto at = [&](const std::optional<std::size_t>& column) { return values[*column]; };
    points.positions.push_back({at(columns.position[0]), at(columns.position[1]), at(columns.position[2])});
    if (Columns::has(columns.normal))
        points.normals.push_back({at(columns.normal[0]), at(columns.normal[1]), at(columns.normal[2])});
    if (Columns::has(columns.color)) {
        const auto part = [&](std::size_t i) {
            return light_of(at(columns.color[i]), element.properties[*columns.color[i]].type);
        };
        points.colors.push_back({part(0), part(1), part(2)});
    }
}

/// Normals that are not usable are left to be found anew.
void check_normals(Points& points) {
    for (Vec3& normal : points.normals) {
        const double size = length(normal);
        if (!(size > 0 && std::isfinite(size))) return points.normals.clear();
        normal = normal / size;
    }
}

std::optional<double> parse_double(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || status != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

void read_text(const std::string& file, const Element& element, const Columns& columns, std::string_view data,
               Points& points) {
    std::vector<double> values(element.properties.size());
    for (std::size_t i = 0; i < element.count; ++i) {
        std::string_view line;
        do {
            data.remove_prefix(std::min(data.find_first_not_of(" \t\r\n"), data.size()));
            line = data.substr(0, data.find_first_of("\r\n"));
            data.remove_prefix(line.size());
        } while (line.starts_with("comment"));
        Words words(line);
        for (double& value : values) {
            const std::string_view word = words.next();
            const auto number = parse_double(word);
            if (!number)
                reject_file(
                    file,
                    fmt::format("element '{}' {} has '{}'", element.name, i, one_line(std::string(word.substr(0, 40)))),
                    "a number");
            value = *number;
        }
        add_point(values, columns, element, points);
    }
}

void read_binary(const Header& header, const Element& element, const Columns& columns, std::string_view data,
                 Points& points) {
    std::vector<double> values(element.properties.size());
    const char* at = data.data();
    for (std::size_t i = 0; i < element.count; ++i) {
        for (std::size_t k = 0; k < values.size(); ++k) {
            values[k] = binary_value(at, element.properties[k].type, header.format);
            at += element.properties[k].type.size;
        }
        add_point(values, columns, element, points);
    }
}

/// The numbers of a line, separated by blanks, commas or semicolons; none for a comment or an empty line.
std::vector<double> numbers_of(const std::string& file, std::string_view line, std::size_t number, bool& has_points) {
    constexpr std::string_view separators = " \t,;\r";
    std::vector<double> values;
    for (std::size_t at = 0; (at = line.find_first_not_of(separators, at)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
        const std::string_view word = line.substr(at, end - at);
        if (word.starts_with('#') || word.starts_with("//")) break;
        const auto value = parse_double(word);
        if (!value)
            reject_file(file, fmt::format("line {} has '{}'", number, one_line(std::string(word.substr(0, 40)))),
                        "numbers: x y z and a colour or a normal");
        has_points |= word.find('.') != word.npos;
        values.push_back(*value);
        at = end;
    }
    return values;
}

/// What the numbers behind the coordinates of a text mean, from all of its lines.
void add_attributes(const std::vector<std::array<double, 3>>& values, bool are_fractions, Points& points) {
    bool unit = true, is_light = true;
    double largest = 0;
    for (const auto& [a, b, c] : values) {
        unit = unit && std::abs(std::sqrt(a * a + b * b + c * c) - 1) < 0.02;
        is_light = is_light && a >= 0 && b >= 0 && c >= 0 && a <= 255 && b <= 255 && c <= 255;
        largest = std::max({largest, a, b, c});
    }
    if (unit) {
        for (const auto& [a, b, c] : values) points.normals.push_back({a, b, c});
    } else if (is_light) {
        const double scale = are_fractions && largest <= 1 ? 1 : 1 / 255.0;
        const auto light = [&](double value) { return srgb_decode(static_cast<float>(scale * value)); };
        for (const auto& [a, b, c] : values) points.colors.push_back({light(a), light(b), light(c)});
    }
}

}  // namespace

void reject_splats(const std::string& file) {
    reject_file(file, "holds Gaussian splats, which are no surfaces", "a mesh or a point cloud");
}

std::optional<Points> read_ply_points(const std::string& file, std::string_view bytes) {
    const Header header = parse_header(file, bytes);
    const Element* vertices = nullptr;
    std::size_t offset = header.size;
    for (const Element& element : header.elements) {
        for (const Property& property : element.properties)
            if (property.name.starts_with("f_dc_")) reject_splats(file);
        const bool is_surface = element.name == "face" || element.name == "tristrips";
        if (is_surface && element.count > 0) return std::nullopt;
        if (element.name == "vertex") vertices = &element;
    }
    if (vertices == nullptr || vertices != &header.elements.front()) return std::nullopt;
    const Columns columns(*vertices);
    const bool has_lists =
        std::ranges::any_of(vertices->properties, [](const Property& p) { return p.count.has_value(); });
    if (!Columns::has(columns.position) || has_lists) return std::nullopt;
    if (vertices->count == 0) reject_file(file, "has neither faces nor points", "a mesh or a point cloud");
    Points points;
    if (header.format == Format::ascii)
        read_text(file, *vertices, columns, bytes.substr(offset), points);
    else
        read_binary(header, *vertices, columns, bytes.substr(offset), points);
    check_normals(points);
    return points;
}

Points read_xyz(const std::string& file, std::string_view bytes) {
    Points points;
    std::vector<std::array<double, 3>> attributes;
    std::size_t number = 0, width = 0;
    bool have_points = false;
    while (!bytes.empty()) {
        const std::string_view line = bytes.substr(0, bytes.find('\n'));
        bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
        bool has_points = false;
        const std::vector<double> values = numbers_of(file, line, ++number, has_points);
        if (values.empty() || (values.size() == 1 && points.positions.empty())) continue;  // a count of points
        if (width == 0) width = values.size();
        if (values.size() != width || width < 3)
            reject_file(file, fmt::format("line {} has {} numbers", number, values.size()),
                        width < 3 ? "three or more" : fmt::format("{}, as the lines before", width));
        points.positions.push_back({values[0], values[1], values[2]});
        if (width >= 6) {
            const std::size_t first = width == 7 ? 4 : 3;  // an intensity stands before the colour
            attributes.push_back({values[first], values[first + 1], values[first + 2]});
            have_points |= has_points;
        }
    }
    if (points.positions.empty()) reject_file(file, "has no points", "lines of x y z");
    if (!attributes.empty()) add_attributes(attributes, have_points, points);
    check_normals(points);
    return points;
}

}  // namespace hogel::scene::mesh_files
