// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/off.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/face_meshes.h"
#include "hogel/scene/mesh_files/polygons.h"

namespace hogel::scene::mesh_files {
namespace {

constexpr std::string_view off_spaces = " \t\r\f\v";

/// Lines without comments; skips empty ones.
class Lines {
  public:
    Lines(const std::string& file, std::string_view bytes) : file_(&file), rest_(bytes) {}

    /// Returns false at the end of the file.
    bool next() {
        while (!rest_.empty()) {
            const std::size_t end = std::min(rest_.find('\n'), rest_.size());
            line_ = rest_.substr(0, end);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            ++number_;
            line_ = line_.substr(0, line_.find('#'));
            if (!at_end()) return true;
        }
        return false;
    }
    bool at_end() {
        line_.remove_prefix(std::min(line_.find_first_not_of(off_spaces), line_.size()));
        return line_.empty();
    }
    std::string_view word() {
        if (at_end()) reject("ends early", "a further number");
        const std::string_view word = line_.substr(0, line_.find_first_of(off_spaces));
        line_.remove_prefix(word.size());
        return word;
    }
    template <class T>
    T number(const char* expected) {
        const std::string_view text = word();
        const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
        T value{};
        const auto [end, status] = std::from_chars(begin, text.data() + text.size(), value);
        if (status != std::errc{} || end != text.data() + text.size())
            reject(fmt::format("has '{}'", one_line(std::string(text.substr(0, 40)))), expected);
        return value;
    }
    /// Reads a number, which may be on the next line.
    std::uint32_t count() {
        if (at_end() && !next()) reject("is the last", "the numbers of vertices and faces");
        return number<std::uint32_t>("a whole number");
    }
    bool take(std::string_view start) {
        if (!line_.starts_with(start)) return false;
        line_.remove_prefix(start.size());
        return true;
    }
    std::size_t bytes_left() const { return rest_.size(); }
    const std::string& file() const { return *file_; }
    [[noreturn]] void reject(const std::string& what, const std::string& expected) const {
        reject_file(*file_, fmt::format("line {} {}", number_, what), expected);
    }

  private:
    const std::string* file_;
    std::string_view rest_, line_;
    std::size_t number_ = 0;
};

struct OffHeader {
    bool has_texture = false, has_colors = false, has_normals = false, has_weight = false, has_dimensions = false;
    unsigned dimensions = 3;
    std::uint32_t vertices = 0, faces = 0;
};

/// Parses the letters before "OFF".
bool take_keyword(Lines& lines, OffHeader& header) {
    header.has_texture = lines.take("ST");
    header.has_colors = lines.take("C");
    header.has_normals = lines.take("N");
    header.has_weight = lines.take("4");
    header.has_dimensions = lines.take("n");
    return lines.take("OFF");
}

OffHeader read_header(Lines& lines) {
    OffHeader header;
    if (!lines.next()) reject_file(lines.file(), "has no line", "an OFF file");
    // Without keyword, the first line begins with the number of vertices.
    Lines first = lines;
    if (take_keyword(first, header)) {
        lines = first;
        if (!lines.at_end() && lines.take("BINARY")) lines.reject("says BINARY", "an OFF file of text");
    } else {
        header = {};
    }
    if (header.has_dimensions) header.dimensions = lines.count();
    if (header.dimensions > 3 || (header.has_dimensions && header.has_weight))
        lines.reject("says more than three dimensions", "at most three");
    header.vertices = lines.count();
    header.faces = lines.count();
    // The shortest line of a vertex or a face is "0\n".
    if (header.vertices > lines.bytes_left() / 2 || header.faces > lines.bytes_left() / 2)
        lines.reject(fmt::format("announces {} vertices and {} faces", header.vertices, header.faces),
                     fmt::format("what {} further bytes can hold", lines.bytes_left()));
    return header;
}

void read_vertex(Lines& lines, const OffHeader& header, Vertices& vertices) {
    const auto number = [&] { return lines.number<float>("a number"); };
    const auto coordinate = [&] { return lines.number<double>("a number"); };
    double coordinates[4] = {0, 0, 0, 1};
    for (unsigned i = 0; i < header.dimensions; ++i) coordinates[i] = coordinate();
    if (header.has_weight) coordinates[3] = coordinate();
    vertices.positions.push_back(
        {coordinates[0] / coordinates[3], coordinates[1] / coordinates[3], coordinates[2] / coordinates[3]});
    if (header.has_normals) {
        const float x = number(), y = number(), z = number();
        vertices.normals.push_back({x, y, z});
    }
    if (header.has_colors) {
        const float r = number(), g = number(), b = number();
        vertices.colors.push_back({r, g, b});
        // An opacity may follow; with texture coordinates it is ambiguous.
        if (!header.has_texture) return;
    }
    if (header.has_texture) {
        const float u = number(), v = number();
        if (header.has_colors && !lines.at_end()) {  // then u was the opacity
            const float w = number();
            vertices.coordinates.push_back({v, w});
        } else {
            vertices.coordinates.push_back({u, v});
        }
    }
}

/// Converts display values, 0 to 1 or 0 to 255, to linear light.
void decode(std::vector<Rgb>& colors) {
    float largest = 0;
    for (const Rgb& c : colors) largest = std::max({largest, c.r, c.g, c.b});
    const float scale = largest > 1 ? 255.0f : 1.0f;
    for (Rgb& c : colors) c = {srgb_decode(c.r / scale), srgb_decode(c.g / scale), srgb_decode(c.b / scale)};
}

constexpr Rgb grey{0.6f, 0.6f, 0.6f};  // default colour

/// Faces of a file, concatenated.
struct Faces {
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> ends;  ///< of each face, in `corners`
    std::vector<bool> have_color;   ///< of each face
    std::vector<Rgb> colors;        ///< of the faces that have one
    std::size_t numbered = 0;       ///< number of faces with an index into an external colour table
};

void read_face(Lines& lines, std::uint32_t vertices, Faces& faces) {
    const auto count = lines.number<std::uint32_t>("a number of corners");
    for (std::uint32_t k = 0; k < count; ++k) {
        faces.corners.push_back(lines.number<std::uint32_t>("the number of a vertex"));
        if (faces.corners.back() >= vertices)
            lines.reject(fmt::format("has the vertex index {}", faces.corners.back()),
                         fmt::format("less than {}", vertices));
    }
    faces.ends.push_back(faces.corners.size());
    std::vector<float> color;
    while (!lines.at_end() && color.size() < 4) color.push_back(lines.number<float>("a colour"));
    faces.have_color.push_back(color.size() >= 3);  // opacity may follow
    if (color.size() >= 3) faces.colors.push_back({color[0], color[1], color[2]});
    if (color.size() == 1) ++faces.numbered;
}

Mesh mesh_of(const Vertices& vertices, const Faces& faces, const std::string& file) {
    const bool from_faces = !faces.colors.empty() && vertices.colors.empty();
    FaceMeshes parts(vertices, {.colors = from_faces});
    Mesh& mesh = parts.mesh(0);
    if (!from_faces && vertices.colors.empty()) mesh.material.base_color = grey;
    std::vector<std::uint32_t> polygon;
    std::size_t next = 0;
    auto color = faces.colors.begin();
    for (std::size_t i = 0; i < faces.ends.size(); ++i) {
        CornerAttributes attributes;
        if (from_faces) attributes.color = faces.have_color[i] ? *color++ : grey;
        polygon.clear();
        for (; next < faces.ends[i]; ++next) polygon.push_back(parts.corner(faces.corners[next], 0, attributes));
        add_polygon(polygon, false, file, mesh);
    }
    return std::move(mesh);
}

}  // namespace

bool starts_like_off(std::string_view bytes) {
    const std::string none;
    Lines lines(none, bytes.substr(0, 4096));
    OffHeader header;
    return lines.next() && take_keyword(lines, header);
}

Imported read_off(const std::string& file, std::string_view bytes) {
    Lines lines(file, bytes);
    const OffHeader header = read_header(lines);
    Vertices vertices;
    for (std::uint32_t i = 0; i < header.vertices; ++i) {
        if (!lines.next()) reject_file(file, fmt::format("has {} vertices", i), fmt::format("{}", header.vertices));
        read_vertex(lines, header, vertices);
    }
    Faces faces;
    for (std::uint32_t i = 0; i < header.faces; ++i) {
        if (!lines.next()) reject_file(file, fmt::format("has {} faces", i), fmt::format("{}", header.faces));
        read_face(lines, header.vertices, faces);
    }
    decode(vertices.colors);
    decode(faces.colors);
    normalize_or_clear(vertices.normals);
    Imported imported;
    imported.has_singles = false;
    imported.meshes.push_back({mesh_of(vertices, faces, file)});
    if (faces.numbered > 0)
        imported.notes.push_back(fmt::format(
            "colours of {} faces are left out: they are numbers in a table of another file", faces.numbered));
    if (!faces.colors.empty() && !vertices.colors.empty())
        imported.notes.push_back("colours of faces are left out: vertices have colours");
    return imported;
}

}  // namespace hogel::scene::mesh_files
