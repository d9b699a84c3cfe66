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

/// Where the next number of a line begins with its point, from a place on; npos: nowhere.
std::size_t find_bare_point(std::string_view line, std::size_t from) {
    for (std::size_t at = from; (at = line.find('.', at)) != line.npos; ++at) {
        std::size_t before = at;
        if (before > 0 && (line[before - 1] == '-' || line[before - 1] == '+')) --before;
        if (before > 0 && is_space(line[before - 1]) && at + 1 < line.size() && is_digit(line[at + 1])) return at;
    }
    return line.npos;
}

}  // namespace

std::string with_leading_zeros(std::string text) {
    std::string whole;
    std::size_t done = 0, end = 0, lines = 0;
    for (std::size_t begin = 0; begin < text.size(); begin = end + 1) {
        if (lines++ % between_checks == 0) core::throw_if_stopped();
        end = std::min(text.find('\n', begin), text.size());
        std::string_view line(text.data() + begin, end - begin);
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (!line.starts_with('v')) continue;
        const auto first = static_cast<std::size_t>(line.data() - text.data());
        for (std::size_t at = find_bare_point(line, 0); at != line.npos; at = find_bare_point(line, at + 1)) {
            if (whole.empty()) whole.reserve(text.size() + text.size() / 8);
            whole.append(text, done, first + at - done).push_back('0');
            done = first + at;
        }
    }
    return done == 0 ? text : whole.append(text, done);
}

namespace {

struct ObjVertex {
    Vec3 position;
    std::size_t begin = 0, end = 0;  ///< of the three numbers, in the line
};

/// The vertex of a line "v x y z ...".
std::optional<ObjVertex> parse_vertex(std::string_view line) {
    const std::size_t key = std::min(line.find_first_not_of(" \t"), line.size());
    if (line.size() < key + 2 || line[key] != 'v' || !is_space(line[key + 1])) return std::nullopt;
    ObjVertex vertex;
    std::size_t at = key + 1;
    double values[3] = {};
    for (double& value : values) {
        at = line.find_first_not_of(" \t", at);
        if (at == line.npos) return std::nullopt;
        if (vertex.begin == 0) vertex.begin = at;
        if (line[at] == '+') ++at;
        const auto [end, status] = std::from_chars(line.data() + at, line.data() + line.size(), value);
        if (status != std::errc{}) return std::nullopt;
        at = static_cast<std::size_t>(end - line.data());
    }
    vertex.position = {values[0], values[1], values[2]};
    vertex.end = at;
    return vertex;
}

/// Calls `visit` with each line, its end included, and its vertex if it has one, until `visit` returns false.
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
    constexpr double far = 1000;  // times the size; single floats then have 13 bits and fewer for it
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
