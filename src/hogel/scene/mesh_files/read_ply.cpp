// SPDX-License-Identifier: Apache-2.0
#include "hogel/scene/mesh_files/read_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "hogel/image.h"
#include "hogel/scene/mesh_files/checks.h"
#include "hogel/scene/mesh_files/face_meshes.h"
#include "hogel/scene/mesh_files/ply.h"
#include "hogel/scene/mesh_files/polygons.h"

namespace hogel::scene::mesh_files {

using namespace ply;

namespace {

/// Index of a property in its element; none if missing.
using Column = std::optional<std::size_t>;

enum class Kind { value, list };

Column find_column(const Element& element, Kind kind, std::initializer_list<std::string_view> names) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const Property& property = element.properties[i];
        if (property.count.has_value() == (kind == Kind::list) && std::ranges::count(names, property.name) > 0)
            return i;
    }
    return std::nullopt;
}

template <std::size_t n>
bool has(const std::array<Column, n>& columns) {
    return std::ranges::all_of(columns, [](const Column& column) { return column.has_value(); });
}

std::array<Column, 3> color_columns(const Element& element) {
    return {find_column(element, Kind::value, {"red", "r", "diffuse_red"}),
            find_column(element, Kind::value, {"green", "g", "diffuse_green"}),
            find_column(element, Kind::value, {"blue", "b", "diffuse_blue"})};
}

/// Converts a display value to linear light; integers are fractions of their maximum.
float light_of(double value, const Type& type) {
    const double largest = !type.is_integer ? 1 : type.size == 1 ? 255 : 65535;
    return srgb_decode(static_cast<float>(value / largest));
}

Rgb color_of(const Row& row, const Element& element, const std::array<Column, 3>& columns) {
    const auto part = [&](std::size_t i) {
        return light_of(row[*columns[i]][0], element.properties[*columns[i]].type);
    };
    return {part(0), part(1), part(2)};
}

Vertices read_vertices(const std::string& file, const Element& element, RowReader& reader) {
    const auto value = [&](std::initializer_list<std::string_view> names) {
        return find_column(element, Kind::value, names);
    };
    const std::array<Column, 3> position{value({"x"}), value({"y"}), value({"z"})};
    const std::array<Column, 3> normal{value({"nx", "normal_x"}), value({"ny", "normal_y"}), value({"nz", "normal_z"})};
    const std::array<Column, 3> color = color_columns(element);
    const std::array<Column, 2> coordinate{value({"u", "s", "tx", "texture_u"}), value({"v", "t", "ty", "texture_v"})};
    if (!has(position)) reject_file(file, "its vertices lack x, y or z", "all three");
    reader.check_room(element);
    Vertices vertices;
    Row row;
    for (std::size_t i = 0; i < element.count; ++i) {
        reader.read(element, i, row);
        const auto component = [&](const Column& column) { return row[*column][0]; };
        vertices.positions.push_back({component(position[0]), component(position[1]), component(position[2])});
        if (has(normal)) vertices.normals.push_back({component(normal[0]), component(normal[1]), component(normal[2])});
        if (has(color)) vertices.colors.push_back(color_of(row, element, color));
        if (has(coordinate))
            vertices.coordinates.push_back(
                {static_cast<float>(component(coordinate[0])), static_cast<float>(component(coordinate[1]))});
    }
    normalize_or_clear(vertices.normals);
    return vertices;
}

struct FaceColumns {
    Column coordinates, picture;
    std::array<Column, 3> color;

    explicit FaceColumns(const Header& header) {
        const auto face = std::ranges::find(header.elements, "face", &Element::name);
        if (face == header.elements.end()) return;
        coordinates = find_column(*face, Kind::list, {"texcoord"});
        picture = find_column(*face, Kind::value, {"texnumber"});
        color = color_columns(*face);
    }
};

/// Builder of the surfaces of a PLY file, from the rows of its faces and strips.
class PlySurfaces {
  public:
    PlySurfaces(const std::string& file, const Header& header, const Vertices& vertices)
        : file_(file),
          pictures_(header.textures.size()),
          vertices_(vertices.positions.size()),
          columns_(header),
          from_faces_{columns_.coordinates.has_value(), has(columns_.color) && vertices.colors.empty(),
                      columns_.picture.has_value()},
          parts_(vertices, from_faces_) {}

    void add_faces(const Element& element, RowReader reader) {
        const std::size_t corners = indices_of(element);
        Row row;
        for (std::size_t i = 0; i < element.count; ++i) {
            reader.read(element, i, row);
            const std::span<const double> indices = row[corners];
            const auto coordinates = columns_.coordinates ? row[*columns_.coordinates] : std::span<const double>{};
            if (!coordinates.empty() && coordinates.size() != 2 * indices.size())
                reject_file(file_,
                            fmt::format("face {} has {} corners and {} texture coordinates", i, indices.size(),
                                        coordinates.size()),
                            "two for each corner");
            const std::size_t picture = picture_of(row);
            CornerAttributes attributes;
            if (from_faces_.colors) attributes.color = color_of(row, element, columns_.color);
            polygon_.clear();
            for (std::size_t k = 0; k < indices.size(); ++k) {
                if (!coordinates.empty())
                    attributes.coordinate = {static_cast<float>(coordinates[2 * k]),
                                             static_cast<float>(coordinates[2 * k + 1])};
                polygon_.push_back(parts_.corner(vertex(indices[k], element, i), picture, attributes));
            }
            add_polygon(polygon_, false, file_, parts_.mesh(picture));
        }
    }

    /// Each vertex of a strip after the second ends a triangle; −1 begins a new strip.
    void add_strips(const Element& element, RowReader reader) {
        const std::size_t corners = indices_of(element);
        Row row;
        for (std::size_t i = 0; i < element.count; ++i) {
            reader.read(element, i, row);
            polygon_.clear();
            for (const double value : row[corners]) {
                if (value == -1) {
                    polygon_.clear();
                    continue;
                }
                polygon_.push_back(parts_.corner(vertex(value, element, i), 0, {}));
                if (polygon_.size() < 3) continue;
                const bool odd = polygon_.size() % 2 == 0;
                add_polygon(std::span(polygon_).last(3), odd, file_, parts_.mesh(0));
            }
        }
    }

    std::vector<ImportedMesh> meshes() && {
        std::vector<ImportedMesh> meshes;
        for (auto& [picture, mesh] : parts_.meshes()) {
            ImportedMesh& imported = meshes.emplace_back();
            imported.mesh = std::move(mesh);
            if (picture < pictures_) imported.texture = static_cast<std::uint32_t>(picture);
        }
        return meshes;
    }

  private:
    std::size_t indices_of(const Element& element) const {
        const Column column = find_column(element, Kind::list, {"vertex_indices", "vertex_index"});
        if (!column && element.count > 0)
            reject_file(file_, fmt::format("element '{}' has no list of vertices", element.name),
                        "a list vertex_indices");
        return column.value_or(0);
    }
    std::size_t vertex(double value, const Element& element, std::size_t number) const {
        const auto count = static_cast<double>(vertices_);
        if (!(value >= 0 && value < count && value == std::floor(value)))
            reject_file(file_, fmt::format("element '{}' {}: vertex index {}", element.name, number, value),
                        fmt::format("a whole number less than {}", count));
        return static_cast<std::size_t>(value);
    }
    std::size_t picture_of(const Row& row) const {
        const double number = columns_.picture ? row[*columns_.picture][0] : 0;
        return number >= 0 && number < static_cast<double>(pictures_) ? static_cast<std::size_t>(number) : pictures_;
    }

    const std::string& file_;
    std::size_t pictures_, vertices_;
    FaceColumns columns_;
    FaceAttributes from_faces_;
    FaceMeshes parts_;
    std::vector<std::uint32_t> polygon_;
};

bool is_surface(const Element& element) { return element.name == "face" || element.name == "tristrips"; }

std::vector<std::string> notes_of(const Header& header, const Vertices& vertices, bool are_points) {
    std::vector<std::string> notes;
    for (const Element& element : header.elements) {
        if (element.name == "face" && !vertices.colors.empty() && has(color_columns(element)))
            notes.push_back("colours of faces are left out: vertices have colours");
        if (element.name == "vertex" && are_points && find_column(element, Kind::value, {"phase"}))
            notes.push_back("phases of points are left out");
        if (element.count > 0 && (element.name == "edge" || element.name == "material"))
            notes.push_back(fmt::format("{} elements '{}' are left out", element.count, element.name));
    }
    return notes;
}

}  // namespace

PlyContents read_ply(const std::string& file, std::string_view bytes) {
    const Header header = parse_header(file, bytes);
    Vertices vertices;
    const Element* vertex = nullptr;
    std::vector<std::pair<const Element*, RowReader>> shapes;  // readers at their first row: vertices may follow
    RowReader reader(file, header.format, bytes.substr(header.size));
    for (const Element& element : header.elements) {
        for (const Property& property : element.properties)
            if (property.name.starts_with("f_dc_") || property.name == "packed_position") reject_splats(file);
        if (element.name == "vertex" && vertex == nullptr) {
            vertex = &element;
            vertices = read_vertices(file, element, reader);
            continue;
        }
        if (is_surface(element)) shapes.emplace_back(&element, reader);
        reader.skip(element);
    }
    if (vertices.positions.empty()) reject_file(file, "has neither faces nor points", "a mesh or a point cloud");
    const bool are_points =
        std::ranges::none_of(header.elements, [](const Element& e) { return is_surface(e) && e.count > 0; });
    PlyContents contents;
    contents.surfaces.notes = notes_of(header, vertices, are_points);
    contents.surfaces.has_singles =
        std::ranges::any_of(vertex->properties, [](const Property& p) { return p.name == "x" && p.type.size == 4; });
    if (are_points) {
        contents.points = std::move(vertices);
        return contents;
    }
    PlySurfaces surfaces(file, header, vertices);
    for (const auto& [element, start] : shapes)
        element->name == "face" ? surfaces.add_faces(*element, start) : surfaces.add_strips(*element, start);
    contents.surfaces.meshes = std::move(surfaces).meshes();
    for (const std::string& name : header.textures)
        contents.surfaces.textures.push_back({TextureSource::Kind::file, name, 0, 0, {}});
    return contents;
}

}  // namespace hogel::scene::mesh_files
