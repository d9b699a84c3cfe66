// SPDX-License-Identifier: Apache-2.0
// Scenes: built-in ones and mesh files, and their placement.
#include "hogel/scene.h"

#include <limits>

#include "core.h"
#include "hogel/pipeline.h"
#include "hogel/shading.h"
#include "keywords.h"
#include "vectors.h"

namespace hogel::python {
namespace {

using py::arg;

// Parameters of Scene.bake(), from keywords.
struct BakeKeywords {
    BakeParameters values;
    Parameters table;

    explicit BakeKeywords(const py::dict& keywords) {
        table.whole("--seed", values.options.seed, std::numeric_limits<std::uint64_t>::max(), "");
        values.declare(table);
        read_keywords(table, keywords);
    }
};

void add_scene_class(py::module_& module) {
    py::class_<SceneCamera> camera(module, "SceneCamera");
    camera.def_readonly("name", &SceneCamera::name)
        .def_readonly("angle", &SceneCamera::angle)
        .def_readonly("height", &SceneCamera::height)
        .def_readonly("nearest", &SceneCamera::nearest);
    add_vector(camera, "position", &SceneCamera::position);
    add_vector(camera, "right", &SceneCamera::right);
    add_vector(camera, "up", &SceneCamera::up);
    py::class_<Scene> scene(module, "Scene");
    scene.def(py::init<>())
        .def_readwrite("name", &Scene::name)
        .def_readwrite("meshes", &Scene::meshes)
        .def_readwrite("lights", &Scene::lights)
        .def_readwrite("has_large_triangles", &Scene::has_large_triangles)
        .def_readonly("notes", &Scene::notes)
        .def_readonly("cameras", &Scene::cameras)
        .def_readonly("provenance", &Scene::provenance)
        .def("copy", [](const Scene& s) { return s; });
    add_vector(scene, "up", &Scene::up);
    add_colour(scene, "ambient", &Scene::ambient);
    add_colour(scene, "background", &Scene::background);
    py::class_<ScenePose> pose(module, "ScenePose");
    pose.def(py::init<>())
        .def_readwrite("camera", &ScenePose::camera)
        .def_readwrite("scale", &ScenePose::scale)
        .def_readwrite("lights", &ScenePose::lights);
    pose.def_property(
        "texture", [](const ScenePose& p) { return std::const_pointer_cast<Image>(p.texture); },
        [](ScenePose& p, const std::shared_ptr<Image>& picture) { p.texture = picture; });
    add_colour(pose, "color", &ScenePose::color);
    add_colour(pose, "background", &ScenePose::background);
    add_colour(pose, "ground", &ScenePose::ground);
    add_vector(pose, "up", &ScenePose::up);
    add_vector(pose, "rotation", &ScenePose::rotation);
    add_vector(pose, "shift", &ScenePose::shift);
}

void add_pictures(py::module_& module) {
    py::class_<ImportOptions>(module, "ImportOptions");
    module.def(
        "scene_of_picture",
        [](const Image& picture,
           const std::optional<py::array_t<float, py::array::c_style | py::array::forcecast>>& map,
           const ImportOptions& options) {
            return run_for(py::none(), [&](const Progress&) {
                if (!map) return scene_of_picture(picture);
                if (map->ndim() != 2) throw Error(ErrorCode::usage, "depth_map", "expected an array of two axes");
                const Shape<2> shape{static_cast<std::size_t>(map->shape(0)), static_cast<std::size_t>(map->shape(1))};
                return scene_of_picture(picture, View<const float, 2>(map->data(), shape), options.depths);
            });
        },
        arg("picture"), arg("depth_map"), arg("options"));
}

void add_scene_functions(py::module_& module) {
    add_pictures(module);
    module.def("scenes", [] {
        std::vector<std::pair<std::string, std::string>> rows;
        for (const SceneInfo& scene : scenes().rows()) rows.emplace_back(scene.name, scene.text);
        return rows;
    });
    module.def(
        "make_scene",
        [](const std::string& name, double hologram_size, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return make_scene(name, hologram_size, p); });
        },
        arg("name"), arg("hologram_size"), arg("report"));
    module.def(
        "find_camera", [](const Scene& scene, const std::string& name) { return find_camera(scene, name); },
        arg("scene"), arg("name"));
    module.def(
        "frame_scene",
        [](Scene& scene, const SceneCamera& camera, double width, double height, double front) {
            return frame_scene(scene, camera, {width, height, Fit().fill, front});
        },
        arg("scene"), arg("camera"), arg("width"), arg("height"), arg("front") = 0.0);
    module.def(
        "import_scene",
        [](const std::filesystem::path& path, const ImportOptions& options, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return import_scene(path, p, options); });
        },
        arg("path"), arg("options"), arg("report"));
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
    module.def("bake_keywords", [] {
        return described(BakeKeywords{py::dict()}.table, [](const Parameter& each) { return each.group != "Scene"; });
    });
    module.def(
        "bake_record",
        [](const py::dict& keywords, const Scene& placed, bool is_file) {
            BakeKeywords asked(keywords);
            asked.values.place.scene.resolve(placed, is_file);
            return asked.table.acting();
        },
        arg("keywords"), arg("placed"), arg("is_file"));
    module.def(
        "bake_scene",
        [](const Scene& scene, const py::dict& keywords, const py::object& report) {
            const BakeOptions options = BakeKeywords(keywords).values.options;
            return run_for(report, [&](const Progress& p) { return bake_scene(scene, options, p); });
        },
        arg("scene"), arg("keywords"), arg("report"));
    module.def("require_baked_scene_name", &require_baked_scene_name, arg("path"));
    module.def(
        "write_baked_scene",
        [](const std::filesystem::path& path, const Scene& scene, const py::object& metadata) {
            const Metadata entries = metadata_of(metadata);
            run(py::none(), [&](const Progress&) { write_baked_scene(path, scene, entries); });
        },
        arg("path"), arg("scene"), arg("metadata"));
}

}  // namespace

void add_scenes(py::module_& module) {
    add_surfaces(module);
    add_scene_class(module);
    add_shading(module);
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
        .def("grids", &LightFieldRequest::grids);
    add_scene_functions(module);
    add_lighting(module);
}

}  // namespace hogel::python
