// SPDX-License-Identifier: Apache-2.0
// All steps from a scene to its hologram and photographs.
#include "hogel/make.h"

#include "core.h"
#include "vectors.h"

namespace hogel::python {
namespace {

using py::arg;

void add_cameras(py::module_& module) {
    py::class_<NamedFocus>(module, "NamedFocus")
        .def_readonly("name", &NamedFocus::name)
        .def_readonly("depth", &NamedFocus::depth);
    py::class_<NamedEye>(module, "NamedEye")
        .def_readonly("name", &NamedEye::name)
        .def_property_readonly("position", [](const NamedEye& eye) { return point_of(eye.position); });
    py::class_<NamedCamera>(module, "NamedCamera")
        .def(py::init([](const std::string& eye_name, const std::string& focus_name, const Camera& camera) {
                 return NamedCamera{eye_name, focus_name, camera};
             }),
             arg("eye_name"), arg("focus_name"), arg("camera"))
        .def_readonly("eye_name", &NamedCamera::eye_name)
        .def_readonly("focus_name", &NamedCamera::focus_name)
        .def_readonly("camera", &NamedCamera::camera)
        .def("wave_file", &NamedCamera::wave_file)
        .def("speckle_free_file", &NamedCamera::speckle_free_file)
        .def("ray_file", &NamedCamera::ray_file);
    module.def(
        "default_focuses",
        [](const Scene& scene, double eye_distance) { return default_focuses(bounds(scene), eye_distance); },
        arg("scene"), arg("eye_distance"));
    module.def("default_eyes", &default_eyes, arg("grid"), arg("eye_distance"), arg("pupil"));
}

void add_requests(py::module_& module) {
    py::class_<MakeRequest>(module, "MakeRequest")
        .def(py::init<>())
        .def_readwrite("light_field", &MakeRequest::light_field)
        .def_readwrite("hologram", &MakeRequest::hologram)
        .def_readwrite("adapt_pitch", &MakeRequest::adapt_pitch)
        .def_readwrite("camera", &MakeRequest::camera)
        .def_readwrite("speckle_free", &MakeRequest::speckle_free)
        .def_property(
            "pupil_samples", [](const MakeRequest& r) { return r.rays.pupil_samples; },
            [](MakeRequest& r, std::size_t samples) { r.rays.pupil_samples = samples; })
        .def_readwrite("eye_distance", &MakeRequest::eye_distance)
        .def_readwrite("pupil", &MakeRequest::pupil)
        .def_readwrite("resolution", &MakeRequest::resolution)
        .def_readwrite("cameras", &MakeRequest::cameras);
    module.def(
        "resolve", [](const MakeRequest& request, const Scene& scene) { return resolve(request, bounds(scene)); },
        arg("request"), arg("scene"));
    module.def("cameras_of", &cameras_of, arg("request"));
    module.def(
        "is_speckle_free_cheap",
        [](const LightField& light_field, const HologramRequest& hologram, const std::vector<Camera>& cameras,
           const CameraModel& model) { return is_speckle_free_cheap(light_field.grids(), hologram, cameras, model); },
        arg("light_field"), arg("hologram"), arg("cameras"), arg("model"));
}

// Class of the results; pictures are copied.
void add_made(py::module_& module) {
    py::class_<ComparedImage>(module, "ComparedImage")
        .def_property_readonly("image", [](const ComparedImage& compared) { return compared.image; })
        .def_property_readonly("comparison",
                               [](const ComparedImage& compared) { return dictionary_of(compared.comparison); });
    py::class_<MadePhotographs>(module, "MadePhotographs")
        .def_readonly("camera", &MadePhotographs::camera)
        .def_property_readonly("rays", [](const MadePhotographs& by) { return by.rays; })
        .def_readonly("waves", &MadePhotographs::waves)
        .def_readonly("speckle_free", &MadePhotographs::speckle_free);
    py::class_<Made>(module, "Made")
        .def_readonly("request", &Made::request)
        .def_readonly("light_field", &Made::light_field)
        .def_readonly("holograms", &Made::holograms)
        .def_readonly("exposure", &Made::exposure)
        .def_readonly("photographs", &Made::photographs);
}

}  // namespace

void add_make(py::module_& module) {
    add_cameras(module);
    add_requests(module);
    add_made(module);
    module.def(
        "make",
        [](const Scene& scene, const MakeRequest& request, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return make(scene, request, {}, p); });
        },
        arg("scene"), arg("request"), arg("report"));
    module.def(
        "write_photographs",
        [](const std::filesystem::path& folder, const Made& made, const py::object& metadata) {
            const Metadata entries = metadata_of(metadata);
            run(py::none(), [&](const Progress& p) {
                write_photographs(folder, made, {entries, entries, entries}, p);
            });
        },
        arg("folder"), arg("made"), arg("metadata"));
}

}  // namespace hogel::python
