// SPDX-License-Identifier: Apache-2.0
// Scenes: built-in ones, mesh files, and meshes from arrays.
#include "hogel/scenes.h"

#include <algorithm>

#include "arrays.h"
#include "core.h"
#include "hogel/bake.h"
#include "hogel/pipeline.h"

namespace hogel::python {
namespace {

using py::arg;
using Point = std::array<double, 3>;
using Colour = std::array<float, 3>;

Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }
Point point_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Rgb rgb_of(const Colour& c) { return {c[0], c[1], c[2]}; }
Colour colour_of(const Rgb& c) { return {c.r, c.g, c.b}; }

// A property of type Vec3 or Rgb as a tuple of three numbers.
template <class Class, class Struct>
void add_vector(Class& to, const char* name, Vec3 Struct::*member) {
    to.def_property(
        name, [member](const Struct& s) { return point_of(s.*member); },
        [member](Struct& s, const Point& p) { s.*member = vector_of(p); });
}
template <class Class, class Struct>
void add_colour(Class& to, const char* name, Rgb Struct::*member) {
    to.def_property(
        name, [member](const Struct& s) { return colour_of(s.*member); },
        [member](Struct& s, const Colour& c) { s.*member = rgb_of(c); });
}

// Rows of an array [n][Columns]; None: no rows.
template <class Row, class T, std::size_t Columns>
std::vector<Row> rows_of(const std::optional<py::array_t<T, py::array::c_style>>& array, const char* what) {
    if (!array) return {};
    const Shape<2> shape = shape_of<2>(*array, what);
    if (shape[1] != Columns)
        throw Error(ErrorCode::usage, std::string(what) + ": rows of " + std::to_string(Columns) +
                                          " numbers were expected, not of " + std::to_string(shape[1]));
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
        if constexpr (std::is_same_v<Row, Vec3>) {
            *to++ = row.x, *to++ = row.y, *to++ = row.z;
        } else if constexpr (std::is_same_v<Row, Rgb>) {
            *to++ = row.r, *to++ = row.g, *to++ = row.b;
        } else {
            for (const auto index : row) *to++ = index;
        }
    }
    return array;
}

void add_materials(py::module_& module) {
    py::class_<Material> material(module, "Material");
    material.def(py::init<>())
        .def_readwrite("reflectance", &Material::reflectance)
        .def_readwrite("metallic", &Material::metallic)
        .def_readwrite("roughness", &Material::roughness)
        .def_readwrite("alpha", &Material::alpha)
        .def_readwrite("alpha_cutoff", &Material::alpha_cutoff)
        .def_readwrite("double_sided", &Material::double_sided);
    add_colour(material, "base_color", &Material::base_color);
    add_colour(material, "emission", &Material::emission);
    material.def("set_texture", [](Material& m, const Image& picture) {
        m.base_color_texture = std::make_shared<const Image>(picture);
    });
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
        .def_readwrite("casts_shadows", &Light::casts_shadows);
    add_vector(light, "position", &Light::position);
    add_vector(light, "direction", &Light::direction);
    add_colour(light, "intensity", &Light::intensity);
}

void add_scene_class(py::module_& module) {
    py::class_<Scene> scene(module, "Scene");
    scene.def(py::init<>())
        .def_readwrite("name", &Scene::name)
        .def_readwrite("meshes", &Scene::meshes)
        .def_readwrite("lights", &Scene::lights)
        .def_readwrite("has_large_triangles", &Scene::has_large_triangles)
        .def_readonly("notes", &Scene::notes)
        .def_property_readonly("is_lit",
                               [](const Scene& s) {
                                   return std::ranges::any_of(s.meshes,
                                                              [](const Mesh& mesh) { return mesh.radiance.empty(); });
                               })
        .def_property_readonly("has_points",
                               [](const Scene& s) {
                                   return std::ranges::any_of(
                                       s.meshes, [](const Mesh& mesh) { return mesh.name == points_name; });
                               })
        .def("copy", [](const Scene& s) { return s; });
    add_colour(scene, "ambient", &Scene::ambient);
    add_colour(scene, "background", &Scene::background);
    py::class_<ScenePose> pose(module, "ScenePose");
    pose.def(py::init<>())
        .def_readwrite("camera", &ScenePose::camera)
        .def_readwrite("scale", &ScenePose::scale)
        .def_readwrite("lights", &ScenePose::lights)
        .def_property(
            "color", [](const ScenePose& p) { return p.color ? std::optional(colour_of(*p.color)) : std::nullopt; },
            [](ScenePose& p, const Colour& c) { p.color = rgb_of(c); })
        .def_property(
            "background",
            [](const ScenePose& p) { return p.background ? std::optional(colour_of(*p.background)) : std::nullopt; },
            [](ScenePose& p, const Colour& c) { p.background = rgb_of(c); })
        .def_property(
            "ground", [](const ScenePose& p) { return p.ground ? std::optional(colour_of(*p.ground)) : std::nullopt; },
            [](ScenePose& p, const Colour& c) { p.ground = rgb_of(c); })
        .def_property(
            "up", [](const ScenePose& p) { return p.up ? std::optional(point_of(*p.up)) : std::nullopt; },
            [](ScenePose& p, const Point& up) { p.up = vector_of(up); })
        .def("set_texture",
             [](ScenePose& p, const Image& picture) { p.texture = std::make_shared<const Image>(picture); });
    add_vector(pose, "rotation", &ScenePose::rotation);
    add_vector(pose, "shift", &ScenePose::shift);
}

void add_scene_functions(py::module_& module) {
    module.def("scenes", [] {
        std::vector<std::pair<std::string, std::string>> rows;
        for (const SceneInfo& scene : scenes().rows()) rows.emplace_back(scene.name, scene.text);
        return rows;
    });
    module.def(
        "import_scene",
        [](const std::filesystem::path& path, double point_size, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return import_scene(path, p, {point_size}); });
        },
        arg("path"), arg("point_size"), arg("report"));
    module.def(
        "load_scene",
        [](const std::string& name, const LightFieldRequest& request, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return load_scene(name, request, p); });
        },
        arg("name"), arg("request"), arg("report"));
    module.def(
        "prepare_scene",
        [](const Scene& scene, const LightFieldRequest& request) {
            return run_for(py::none(), [&](const Progress&) { return prepare_scene(scene, request); });
        },
        arg("scene"), arg("request"));
    module.def("add_missing_normals", &add_missing_normals, arg("scene"), arg("crease"));
    module.def("add_default_lights", &add_default_lights, arg("scene"));
    module.def("turn_scene", &turn_scene, arg("scene"), arg("pose"));
    module.def("place_scene", &place_scene, arg("scene"), arg("pose"), arg("hologram_width"));
    module.def(
        "fit_scene",
        [](Scene& scene, double width, double height, double fill, double front) {
            fit_scene(scene, {width, height, fill, front});
        },
        arg("scene"), arg("width"), arg("height"), arg("fill") = Fit().fill, arg("front") = 0.0);
    module.def("triangle_count", &triangle_count, arg("scene"));
    module.def("checksum", &checksum, arg("scene"));
    module.def(
        "validate_scene", [](const Scene& scene) { validate(scene); }, arg("scene"));
    module.def(
        "bounds",
        [](const Scene& scene) {
            const Bounds box = bounds(scene);
            return py::make_tuple(point_of(box.low), point_of(box.high));
        },
        arg("scene"));
    module.def(
        "bake_scene",
        [](const Scene& scene, std::size_t rays, std::size_t bounces, std::size_t tessellation, std::uint64_t seed,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) {
                return bake_scene(scene, {rays, bounces, tessellation, seed}, p);
            });
        },
        arg("scene"), arg("rays"), arg("bounces"), arg("tessellation"), arg("seed"), arg("report"));
    module.def("require_baked_scene_name", &require_baked_scene_name, arg("path"));
    module.def(
        "write_baked_scene",
        [](const std::filesystem::path& path, const Scene& scene, const py::object& metadata) {
            const Metadata entries = metadata_of(metadata);
            run(py::none(), [&](const Progress&) { write_baked_scene(path, scene, entries); });
        },
        arg("path"), arg("scene"), arg("metadata"));
}

void add_shading(py::module_& module) {
    py::class_<ShadedScene, std::shared_ptr<ShadedScene>>(module, "ShadedScene")
        .def_property_readonly("is_lit",
                               [](const ShadedScene& s) {
                                   for (std::size_t i = 0; i < s.triangles.size(); ++i)
                                       if (s.is_lit(i)) return true;
                                   return false;
                               })
        .def_readonly("metadata", &ShadedScene::provenance);
    module.def(
        "light_scene",
        [](const Scene& scene, const LightFieldRequest& request, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return light_scene(scene, request, p); });
        },
        arg("scene"), arg("request"), arg("report"));
    module.def("shadow_map_bytes", &shadow_map_bytes, arg("scene"), arg("options"));
}

}  // namespace

void add_scenes(py::module_& module) {
    add_materials(module);
    add_lights(module);
    add_scene_class(module);
    py::class_<ShadingOptions>(module, "ShadingOptions")
        .def(py::init<>())
        .def_readwrite("model", &ShadingOptions::model)
        .def_readwrite("shadow_map", &ShadingOptions::shadow_map)
        .def_readwrite("max_shadow_bytes", &ShadingOptions::max_shadow_bytes)
        .def_readwrite("filter_textures", &ShadingOptions::filter_textures);
    py::class_<LightFieldRequest>(module, "LightFieldRequest")
        .def(py::init<>())
        .def_readwrite("renderer", &LightFieldRequest::renderer)
        .def_readwrite("shading", &LightFieldRequest::shading)
        .def_readwrite("cache_spacing", &LightFieldRequest::cache_spacing)
        .def_readwrite("grid", &LightFieldRequest::grid)
        .def_readwrite("hemicube", &LightFieldRequest::hemicube)
        .def_property(
            "samples", [](const LightFieldRequest& r) { return py::make_tuple(r.samples.hogel, r.samples.direction); },
            [](LightFieldRequest& r, const std::pair<std::size_t, std::size_t>& samples) {
                r.samples = {samples.first, samples.second};
            })
        .def_readwrite("cull_back_faces", &LightFieldRequest::cull_back_faces)
        .def_readwrite("fit", &LightFieldRequest::fit)
        .def_readwrite("front", &LightFieldRequest::front)
        .def_readwrite("pose", &LightFieldRequest::pose)
        .def_readwrite("hemicube_across", &LightFieldRequest::hemicube_across)
        .def_readwrite("hemicube_down", &LightFieldRequest::hemicube_down)
        .def_readwrite("interpolate", &LightFieldRequest::interpolate)
        .def_property(
            "point_size", [](const LightFieldRequest& r) { return r.import.point_size; },
            [](LightFieldRequest& r, double size) { r.import.point_size = size; })
        .def("grids", &LightFieldRequest::grids);
    add_scene_functions(module);
    add_shading(module);
    module.def("renderers", [] { return renderers().names(); });
    module.def("shading_models", [] { return shading_models().names(); });
    module.def("shading_model", &shading_model, arg("scene"), arg("options") = ShadingOptions());
}

}  // namespace hogel::python
