// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hogel/image.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/ply.h"
#include "hogel/scene/mesh_files/points.h"

namespace hogel::scene::mesh_files {

namespace {

/// Parses the numbers of a line, separated by blanks, commas or semicolons; none for a comment or an empty line.
std::vector<double> numbers_of(const std::string& file, std::string_view line, std::size_t number, bool& has_points) {
    constexpr std::string_view separators = " \t,;\r";
    std::vector<double> values;
    for (std::size_t position = 0; (position = line.find_first_not_of(separators, position)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(separators, position), line.size());
        const std::string_view word = line.substr(position, end - position);
        if (word.starts_with('#') || word.starts_with("//")) break;
        const auto value = ply::parse_number(word);
        if (!value)
            reject_file(file, fmt::format("line {} has '{}'", number, one_line(std::string(word.substr(0, 40)))),
                        "numbers: x y z and a colour or a normal");
        has_points |= word.find('.') != word.npos;
        values.push_back(*value);
        position = end;
    }
    return values;
}

/// Adds colours or normals from the columns after the coordinates, decided by all lines.
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

void normalize_or_clear(std::vector<Vec3>& normals) {
    for (Vec3& normal : normals) {
        const double size = length(normal);
        if (!(size > 0 && std::isfinite(size))) return normals.clear();
        normal = normal / size;
    }
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
            const std::size_t first = width == 7 ? 4 : 3;  // an intensity precedes the colour
            attributes.push_back({values[first], values[first + 1], values[first + 2]});
            have_points |= has_points;
        }
    }
    if (points.positions.empty()) reject_file(file, "has no points", "lines of x y z");
    if (!attributes.empty()) add_attributes(attributes, have_points, points);
    normalize_or_clear(points.normals);
    return points;
}

Points read_dat(const std::string& file, std::string_view bytes) {
    Points points;
    std::optional<std::size_t> count;
    std::vector<double> amplitudes;
    std::size_t number = 0;
    while (!bytes.empty()) {
        const std::string_view line = bytes.substr(0, bytes.find('\n'));
        bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
        bool has_points = false;
        const std::vector<double> values = numbers_of(file, line, ++number, has_points);
        if (values.empty()) continue;
        if (values.size() != (count ? 6 : 1))
            reject_file(file, fmt::format("line {} has {} numbers", number, values.size()),
                        count ? "six: index, x, y, z, phase and amplitude" : "one: how many points follow");
        if (!count) {
            count = values[0] >= 0 ? static_cast<std::size_t>(std::min(values[0], 1e12)) : 0;
            continue;
        }
        points.positions.push_back({values[1], values[2], values[3]});
        amplitudes.push_back(values[5]);
    }
    if (points.positions.empty() || points.positions.size() != *count)
        reject_file(file, fmt::format("announces {} points and has {}", count.value_or(0), points.positions.size()),
                    "a point cloud: a count, and a line of index, x, y, z, phase and amplitude for each point");
    const double largest = std::ranges::max(amplitudes);
    if (std::ranges::min(amplitudes) == largest || !(largest > 0)) return points;
    for (const double amplitude : amplitudes) {
        const auto radiance =
            static_cast<float>(std::max(amplitude, 0.0) * std::max(amplitude, 0.0) / largest / largest);
        points.colors.push_back({radiance, radiance, radiance});
    }
    return points;
}

}  // namespace hogel::scene::mesh_files
