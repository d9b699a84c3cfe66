// SPDX-License-Identifier: Apache-2.0
// Resources that work needs, before it begins.
#include "core.h"
#include "hogel/pipeline.h"

namespace hogel::python {
namespace {

using py::arg;

LightFieldFileOptions light_field_file(bool single, bool with_depth) {
    LightFieldFileOptions file;
    file.type = single ? SampleType::single : SampleType::half;
    file.with_depth = with_depth;
    return file;
}

}  // namespace

void add_plans(py::module_& module) {
    py::class_<Plan>(module, "Plan")
        .def(py::init([](double memory, double disk, double seconds) {
                 return Plan{memory, disk, seconds};
             }),
             arg("memory") = 0.0, arg("disk") = 0.0, arg("seconds") = 0.0)
        .def_readonly("memory", &Plan::memory)
        .def_readonly("disk", &Plan::disk)
        .def_readonly("seconds", &Plan::seconds);
    module.def(
        "plan_light_field",
        [](const LightField& rendered, const LightFieldRequest& request, std::size_t triangles, bool single,
           bool with_depth) {
            return plan_light_field(rendered, request, triangles, light_field_file(single, with_depth));
        },
        arg("rendered"), arg("request"), arg("triangles"), arg("single"), arg("with_depth"));
    module.def(
        "plan_holograms",
        [](const LightField& light_field, const HologramRequest& request, bool half) {
            HologramFileOptions file;
            file.type = half ? SampleType::half : SampleType::single;
            return plan_holograms(light_field.grids(), request, file);
        },
        arg("light_field"), arg("request"), arg("half"));
    module.def(
        "plan_photographs",
        [](const LightField& light_field, const HologramRequest& request, const std::vector<Camera>& cameras,
           const CameraModel& model) { return plan_photographs(light_field.grids(), request, cameras, model); },
        arg("light_field"), arg("request"), arg("cameras"), arg("model"));
    module.def(
        "plan_ray_photographs",
        [](const LightField& light_field, const std::vector<Camera>& cameras, std::size_t pupil_samples) {
            return plan_ray_photographs(light_field.grids(), cameras, {pupil_samples});
        },
        arg("light_field"), arg("cameras"), arg("pupil_samples"));
    module.def("plan_compression", &plan_compression, arg("light_field"), arg("options"));
    module.def(
        "plan_import",
        [](const ImportedViews& views, const ViewImportOptions& options, bool single, bool with_depth) {
            return plan_import(views, options, light_field_file(single, with_depth));
        },
        arg("views"), arg("options"), arg("single"), arg("with_depth"));
    module.def("plan_export", &plan_export, arg("light_field"), arg("options"));
    module.def(
        "plan_propagation",
        [](const std::vector<FieldGrid>& fields, double distance, const std::optional<Grid>& output, double max_error) {
            PropagateOptions options;
            options.output = output;
            options.max_error = max_error;
            return plan_propagation(fields, distance, options);
        },
        arg("fields"), arg("distance"), arg("output"), arg("max_error"));
    module.def(
        "plan_bake",
        [](const Scene& scene, std::size_t rays, std::size_t bounces, std::size_t tessellation) {
            BakeOptions options;
            options.rays = rays;
            options.bounces = bounces;
            options.tessellation = tessellation;
            return plan_bake(scene, options);
        },
        arg("scene"), arg("rays"), arg("bounces"), arg("tessellation"));
    py::class_<Advice>(module, "Advice")
        .def_readonly("parameter", &Advice::parameter)
        .def_readonly("text", &Advice::text)
        .def_readonly("enough", &Advice::enough)
        .def_readonly("refused", &Advice::refused);
    module.def(
        "advise",
        [](const Scene& placed, const LightFieldRequest& light_field, const HologramRequest& hologram) {
            return advise(bounds(placed), light_field, hologram);
        },
        arg("placed"), arg("light_field"), arg("hologram"));
    module.def(
        "diffracting_pitch",
        [](const LightField& light_field, const HologramRequest& hologram) {
            return diffracting_pitch(light_field.grids(), hologram);
        },
        arg("light_field"), arg("hologram"));
    module.def("require_resources", &require_resources, arg("plan"), arg("what"), arg("file"));
    module.def("with_history", &with_history, arg("now"), arg("before"));
    module.def(
        "to_metadata",
        [](const Metadata& entries, const std::optional<Camera>& camera) {
            return to_metadata({entries, camera});
        },
        arg("entries"), arg("camera"));
    module.def(
        "to_provenance",
        [](const Metadata& metadata) {
            const Provenance provenance = to_provenance(metadata);
            return std::pair(provenance.entries, provenance.camera);
        },
        arg("metadata"));
    module.def(
        "background_entry",
        [](const std::array<float, 3>& background) {
            return background_entry({background[0], background[1], background[2]});
        },
        arg("background"));
    module.def(
        "background_of",
        [](const Metadata& entries) {
            const Rgb background = background_of({entries, {}});
            return std::array{background.r, background.g, background.b};
        },
        arg("entries"));
    module.def(
        "describe_input",
        [](const std::string& name, const std::optional<Scene>& scene) {
            return scene ? describe_input(name, *scene) : describe_input(name);
        },
        arg("name"), arg("scene") = py::none());
}

}  // namespace hogel::python
