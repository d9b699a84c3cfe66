// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include "hogel/core/stop_scope.h"
#include "hogel/scene/edges.h"

namespace hogel::scene::mesh_files {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns the position of the next number that begins with its decimal point; npos if there is none.
std::size_t find_bare_point(std::string_view line, std::size_t from) {
    for (std::size_t point = from; (point = line.find('.', point)) != line.npos; ++point) {
        std::size_t before = point;
        if (before > 0 && (line[before - 1] == '-' || line[before - 1] == '+')) --before;
        if (before > 0 && is_space(line[before - 1]) && point + 1 < line.size() && is_digit(line[point + 1]))
            return point;
    }
    return line.npos;
}

}  // namespace

std::string with_leading_zeros(std::string text) {
    std::string result;
    std::size_t done = 0, end = 0, lines = 0;
    for (std::size_t begin = 0; begin < text.size(); begin = end + 1) {
        if (lines++ % between_checks == 0) core::throw_if_stopped();
        end = std::min(text.find('\n', begin), text.size());
        std::string_view line(text.data() + begin, end - begin);
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (!line.starts_with('v')) continue;
        const auto first = static_cast<std::size_t>(line.data() - text.data());
        for (std::size_t point = find_bare_point(line, 0); point != line.npos;
             point = find_bare_point(line, point + 1)) {
            if (result.empty()) result.reserve(text.size() + text.size() / 8);
            result.append(text, done, first + point - done).push_back('0');
            done = first + point;
        }
    }
    return done == 0 ? text : result.append(text, done);
}

namespace {

struct ObjVertex {
    Vec3 position;
    std::size_t begin = 0, end = 0;  ///< range of the three numbers in the line
};

/// Parses a line "v x y z ...".
std::optional<ObjVertex> parse_vertex(std::string_view line) {
    const std::size_t key = std::min(line.find_first_not_of(" \t"), line.size());
    if (line.size() < key + 2 || line[key] != 'v' || !is_space(line[key + 1])) return std::nullopt;
    ObjVertex vertex;
    std::size_t position = key + 1;
    double values[3] = {};
    for (double& value : values) {
        position = line.find_first_not_of(" \t", position);
        if (position == line.npos) return std::nullopt;
        if (vertex.begin == 0) vertex.begin = position;
        if (line[position] == '+') ++position;
        const auto [end, status] = std::from_chars(line.data() + position, line.data() + line.size(), value);
        if (status != std::errc{}) return std::nullopt;
        position = static_cast<std::size_t>(end - line.data());
    }
    vertex.position = {values[0], values[1], values[2]};
    vertex.end = position;
    return vertex;
}

/// Calls `visit` with each line, including its newline, and its vertex if any, until `visit` returns false.
template <class Visit>
void for_vertices(std::string_view text, const Visit& visit) {
    for (std::size_t lines = 0; !text.empty(); ++lines) {
        if (lines % between_checks == 0) core::throw_if_stopped();
        const std::size_t size = std::min(text.find('\n'), text.size() - 1) + 1;
        if (!visit(text.substr(0, size), parse_vertex(text.substr(0, size)))) return;
        text.remove_prefix(size);
    }
}

double max_coordinate(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

std::string about_the_origin(std::string text, Vec3& offset) {
    constexpr double far = 1000;  // times the size, which then has at most 13 bits in single floats
    std::optional<Vec3> low, high;
    for_vertices(text, [&](std::string_view, const std::optional<ObjVertex>& vertex) {
        if (!vertex) return true;
        const Vec3 p = vertex->position;
        if (!low) low = high = p;
        low = Vec3{std::min(low->x, p.x), std::min(low->y, p.y), std::min(low->z, p.z)};
        high = Vec3{std::max(high->x, p.x), std::max(high->y, p.y), std::max(high->z, p.z)};
        return far * max_coordinate(*high - *low) < max_coordinate(*low) + max_coordinate(*high);
    });
    offset = {};
    if (!low || !(far * max_coordinate(*high - *low) < max_coordinate(*low))) return text;
    offset = *low;
    std::string moved;
    moved.reserve(text.size());
    for_vertices(text, [&](std::string_view line, const std::optional<ObjVertex>& vertex) {
        if (!vertex) {
            moved += line;
            return true;
        }
        const Vec3 p = vertex->position - offset;
        moved += line.substr(0, vertex->begin);
        fmt::format_to(std::back_inserter(moved), "{} {} {}", p.x, p.y, p.z);
        moved += line.substr(vertex->end);
        return true;
    });
    return moved;
}

}  // namespace hogel::scene::mesh_files
