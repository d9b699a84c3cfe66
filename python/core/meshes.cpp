// SPDX-License-Identifier: Apache-2.0
// Materials, meshes from arrays, and lights.
#include <algorithm>

#include "arrays.h"
#include "core.h"
#include "hogel/scene.h"
#include "vectors.h"

namespace hogel::python {
namespace {

using py::arg;

// Returns the rows of an array [n][Columns]; None: no rows.
template <class Row, class T, std::size_t Columns>
std::vector<Row> rows_of(const std::optional<py::array_t<T, py::array::c_style>>& array, const char* what) {
    if (!array) return {};
    const Shape<2> shape = shape_of<2>(*array, what);
    if (shape[1] != Columns)
        throw Error(ErrorCode::usage, what,
                    std::string(what) + ": expected rows of " + std::to_string(Columns) + " numbers, not of " +
                        std::to_string(shape[1]));
    std::vector<Row> rows(shape[0]);
    for (std::size_t i = 0; i < shape[0]; ++i) {
        const T* row = array->data() + i * Columns;
        if constexpr (Columns == 2)
            rows[i] = {row[0], row[1]};
        else
            rows[i] = {row[0], row[1], row[2]};
    }
    return rows;
}

using Doubles = std::optional<py::array_t<double, py::array::c_style>>;
using Floats = std::optional<py::array_t<float, py::array::c_style>>;
using Indices = std::optional<py::array_t<std::uint32_t, py::array::c_style>>;

Mesh make_mesh(const Doubles& positions, const Indices& triangles, const Doubles& normals, const Floats& colors,
               const Floats& radiance, const Floats& texture_coordinates, const Material& material,
               const std::string& name) {
    Mesh mesh;
    mesh.positions = rows_of<Vec3, double, 3>(positions, "vertices");
    mesh.triangles = rows_of<std::array<std::uint32_t, 3>, std::uint32_t, 3>(triangles, "triangles");
    mesh.normals = rows_of<Vec3, double, 3>(normals, "normals");
    mesh.colors = rows_of<Rgb, float, 3>(colors, "colors");
    mesh.radiance = rows_of<Rgb, float, 3>(radiance, "radiance");
    mesh.texture_coordinates = rows_of<TextureCoordinate, float, 2>(texture_coordinates, "texture_coordinates");
    mesh.material = material;
    mesh.name = name;
    return mesh;
}

template <class Row, class T, std::size_t Columns>
py::array array_from(const std::vector<Row>& rows) {
    py::array_t<T> array({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(Columns)});
    T* to = array.mutable_data();
    for (const Row& row : rows) {
        if constexpr (std::is_same_v<Row, TextureCoordinate>) {
            *to++ = row.u, *to++ = row.v;
        } else if constexpr (std::is_same_v<Row, Vec3>) {
            *to++ = row.x, *to++ = row.y, *to++ = row.z;
        } else if constexpr (std::is_same_v<Row, Rgb>) {
            *to++ = row.r, *to++ = row.g, *to++ = row.b;
        } else {
            for (const auto index : row) *to++ = index;
        }
    }
    return array;
}

// Adds an optional texture as a picture or None.
void add_texture(py::class_<Material>& to, const char* name, std::shared_ptr<const Image> Material::*member) {
    to.def_property(
        name, [member](const Material& m) { return std::const_pointer_cast<Image>(m.*member); },
        [member](Material& m, const std::shared_ptr<Image>& picture) { m.*member = picture; });
}

void add_materials(py::module_& module) {
    py::enum_<AlphaMode>(module, "AlphaMode")
        .value("opaque", AlphaMode::opaque)
        .value("mask", AlphaMode::mask)
        .value("blend", AlphaMode::blend);
    py::class_<TextureSampling> sampling(module, "TextureSampling");
    py::enum_<TextureSampling::Wrap>(sampling, "Wrap")
        .value("repeat", TextureSampling::Wrap::repeat)
        .value("mirror", TextureSampling::Wrap::mirror)
        .value("clamp", TextureSampling::Wrap::clamp);
    sampling.def(py::init<>())
        .def_readwrite("wrap_u", &TextureSampling::wrap_u)
        .def_readwrite("wrap_v", &TextureSampling::wrap_v)
        .def_readwrite("nearest", &TextureSampling::nearest);
    py::class_<Material> material(module, "Material");
    material.def(py::init<>())
        .def_readwrite("reflectance", &Material::reflectance)
        .def_readwrite("metallic", &Material::metallic)
        .def_readwrite("roughness", &Material::roughness)
        .def_readwrite("alpha", &Material::alpha)
        .def_readwrite("alpha_cutoff", &Material::alpha_cutoff)
        .def_readwrite("double_sided", &Material::double_sided)
        .def_readwrite("alpha_mode", &Material::alpha_mode)
        .def_readwrite("base_color_sampling", &Material::base_color_sampling)
        .def_readwrite("emission_sampling", &Material::emission_sampling)
        .def_readwrite("metallic_roughness_sampling", &Material::metallic_roughness_sampling)
        .def_readwrite("normal_sampling", &Material::normal_sampling)
        .def_readwrite("normal_scale", &Material::normal_scale)
        .def_readwrite("occlusion_sampling", &Material::occlusion_sampling)
        .def_readwrite("occlusion_strength", &Material::occlusion_strength)
        .def_property_readonly("is_glossy", &Material::is_glossy);
    add_colour(material, "base_color", &Material::base_color);
    add_colour(material, "emission", &Material::emission);
    add_texture(material, "base_color_texture", &Material::base_color_texture);
    add_texture(material, "emission_texture", &Material::emission_texture);
    add_texture(material, "metallic_roughness_texture", &Material::metallic_roughness_texture);
    add_texture(material, "normal_texture", &Material::normal_texture);
    add_texture(material, "occlusion_texture", &Material::occlusion_texture);
}

// Returns the texture coordinates of a mesh as an array [n][2].
auto coordinates(std::vector<TextureCoordinate> Mesh::*member) {
    return [member](const Mesh& m) { return array_from<TextureCoordinate, float, 2>(m.*member); };
}

void add_meshes(py::module_& module) {
    py::class_<Mesh>(module, "Mesh")
        .def(py::init(&make_mesh), arg("positions"), arg("triangles"), arg("normals") = py::none(),
             arg("colors") = py::none(), arg("radiance") = py::none(), arg("texture_coordinates") = py::none(),
             arg("material") = Material(), arg("name") = "mesh")
        .def_property_readonly("positions", [](const Mesh& m) { return array_from<Vec3, double, 3>(m.positions); })
        .def_property_readonly("normals", [](const Mesh& m) { return array_from<Vec3, double, 3>(m.normals); })
        .def_property_readonly("colors", [](const Mesh& m) { return array_from<Rgb, float, 3>(m.colors); })
        .def_property_readonly("radiance", [](const Mesh& m) { return array_from<Rgb, float, 3>(m.radiance); })
        .def_property_readonly(
            "triangles",
            [](const Mesh& m) { return array_from<std::array<std::uint32_t, 3>, std::uint32_t, 3>(m.triangles); })
        .def_readonly("alphas", &Mesh::alphas)
        .def_property_readonly("texture_coordinates", coordinates(&Mesh::texture_coordinates))
        .def_property_readonly("emission_coordinates", coordinates(&Mesh::emission_coordinates))
        .def_property_readonly("metallic_roughness_coordinates", coordinates(&Mesh::metallic_roughness_coordinates))
        .def_property_readonly("normal_coordinates", coordinates(&Mesh::normal_coordinates))
        .def_property_readonly("occlusion_coordinates", coordinates(&Mesh::occlusion_coordinates))
        .def_readwrite("material", &Mesh::material)
        .def_readwrite("name", &Mesh::name);
}

void add_lights(py::module_& module) {
    py::class_<Light> light(module, "Light");
    py::enum_<Light::Kind>(light, "Kind")
        .value("point", Light::Kind::point)
        .value("directional", Light::Kind::directional);
    light
        .def(py::init([](const Point& direction, const Colour& intensity) {
                 Light made;
                 made.direction = vector_of(direction);
                 made.intensity = rgb_of(intensity);
                 return made;
             }),
             arg("direction"), arg("intensity"))
        .def_readwrite("kind", &Light::kind)
        .def_readwrite("outer_cone", &Light::outer_cone)
        .def_readwrite("inner_cone", &Light::inner_cone)
        .def_readwrite("casts_shadows", &Light::casts_shadows);
    add_vector(light, "position", &Light::position);
    add_vector(light, "direction", &Light::direction);
    add_colour(light, "intensity", &Light::intensity);
}

}  // namespace

void add_surfaces(py::module_& module) {
    add_materials(module);
    add_meshes(module);
    add_lights(module);
}

}  // namespace hogel::python
