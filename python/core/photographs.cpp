// SPDX-License-Identifier: Apache-2.0
// Photographs of holograms by waves and of light fields by rays.
#include "hogel/photograph.h"

#include "arrays.h"
#include "core.h"
#include "hogel/pipeline.h"

namespace hogel::python {

using Source = std::shared_ptr<const FieldSource>;

void add_photographs(py::module_& module) {
    using py::arg;
    py::enum_<BandSource>(module, "BandSource")
        .value("automatic", BandSource::automatic)
        .value("hogel_spectra", BandSource::hogel_spectra)
        .value("samples", BandSource::samples);
    py::class_<BandCamera>(module, "BandCamera")
        .def(py::init<>())
        .def_readwrite("memory", &BandCamera::memory)
        .def_readwrite("source", &BandCamera::source)
        .def_readwrite("vertical_diffuser", &BandCamera::vertical_diffuser)
        .def_readwrite("preview", &BandCamera::preview);
    py::class_<SpeckleFreeCamera>(module, "SpeckleFreeCamera")
        .def(py::init<>())
        .def_readwrite("memory", &SpeckleFreeCamera::memory);
    py::class_<DirectCamera>(module, "DirectCamera")
        .def(py::init([](std::size_t pupil_points, std::size_t subpixels) {
                 return DirectCamera{pupil_points, subpixels};
             }),
             arg("pupil_points") = DirectCamera().pupil_points, arg("subpixels") = DirectCamera().subpixels)
        .def_readwrite("pupil_points", &DirectCamera::pupil_points)
        .def_readwrite("subpixels", &DirectCamera::subpixels);
    py::class_<PlaneWaveCamera>(module, "PlaneWaveCamera")
        .def(py::init([](std::size_t memory, const std::filesystem::path& folder, double film_distance) {
                 return PlaneWaveCamera{{memory, folder}, film_distance};
             }),
             arg("memory") = ScratchOptions().memory, arg("folder") = std::filesystem::path(),
             arg("film_distance") = 0.0)
        .def_property(
            "memory", [](const PlaneWaveCamera& o) { return o.scratch.memory; },
            [](PlaneWaveCamera& o, std::size_t bytes) { o.scratch.memory = bytes; })
        .def_property(
            "folder", [](const PlaneWaveCamera& o) { return o.scratch.folder; },
            [](PlaneWaveCamera& o, const std::filesystem::path& folder) { o.scratch.folder = folder; })
        .def_readwrite("film_distance", &PlaneWaveCamera::film_distance);
    module.def(
        "photograph_colours",
        [](const Fields& holograms, const std::vector<Camera>& cameras, const CameraModel& model,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) { return photograph_colours(holograms, cameras, model, p); });
        },
        arg("holograms"), arg("cameras"), arg("model"), arg("report"));
    module.def(
        "photograph_rays",
        [](const LightField& light_field, const std::vector<Camera>& cameras, std::size_t pupil_samples,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) {
                return photograph(light_field, cameras, RayCamera{pupil_samples}, p);
            });
        },
        arg("light_field"), arg("cameras"), arg("pupil_samples"), arg("report"));
    module.def(
        "photograph",
        [](const Source& hologram, const std::vector<Camera>& cameras, const CameraModel& model,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) { return photograph(*hologram, cameras, model, p); });
        },
        arg("hologram"), arg("cameras"), arg("model"), arg("report"));
    module.def(
        "require_photographs",
        [](const FieldGrid& hologram, const std::vector<Camera>& cameras, const CameraModel& model) {
            require_photographs(hologram, cameras, model);
        },
        arg("hologram"), arg("cameras"), arg("model"));
    py::enum_<FieldQuantity>(module, "FieldQuantity")
        .value("intensity", FieldQuantity::intensity)
        .value("amplitude", FieldQuantity::amplitude)
        .value("phase", FieldQuantity::phase)
        .value("real", FieldQuantity::real);
    module.def(
        "picture_of",
        [](const Source& field, FieldQuantity quantity, std::size_t look, const py::object& report) {
            return run_for(report, [&](const Progress& p) { return picture_of(*field, quantity, look, p); });
        },
        arg("field"), arg("quantity"), arg("look"), arg("report"));
    module.def("logarithmic", &logarithmic, arg("intensities"));
    py::class_<RayPhotographer>(module, "RayPhotographer")
        .def(py::init([](const LightField& light_field, std::size_t memory, const py::object& report) {
                 return run_for(report, [&](const Progress& p) {
                     return std::make_unique<RayPhotographer>(light_field, RayPhotographerOptions{memory}, p);
                 });
             }),
             arg("light_field"), arg("memory") = RayPhotographerOptions().memory, arg("report") = py::none())
        .def(
            "photograph",
            [](RayPhotographer& photographer, const Camera& camera, std::size_t pupil_samples,
               const py::object& report) {
                return run_for(report, [&](const Progress& p) {
                    return photographer.photograph(camera, RayCamera{pupil_samples}, p);
                });
            },
            arg("camera"), arg("pupil_samples") = RayCamera().pupil_samples, arg("report") = py::none());
    py::class_<EyePhotographer>(module, "EyePhotographer")
        .def(py::init([](const Fields& holograms, const CameraModel& model, const py::object& report) {
                 return run_for(
                     report, [&](const Progress& p) { return std::make_unique<EyePhotographer>(holograms, model, p); });
             }),
             arg("holograms"), arg("model") = CameraModel(BandCamera()), arg("report") = py::none())
        .def(
            "photograph",
            [](EyePhotographer& photographer, const Camera& camera, const py::object& report) {
                return run_for(report, [&](const Progress& p) { return photographer.photograph(camera, {}, p); });
            },
            arg("camera"), arg("report") = py::none());
    module.def(
        "waves_in_focus",
        [](const std::shared_ptr<const FieldSource>& hologram, std::size_t look, const std::vector<Camera>& cameras,
           const py::object& report) {
            auto waves =
                run_for(report, [&](const Progress& p) { return waves_in_focus(*hologram, look, cameras, {}, p); });
            py::list arrays;
            for (auto& wave : waves) arrays.append(array_of(std::move(wave)));
            return arrays;
        },
        arg("hologram"), arg("look"), arg("cameras"), arg("report"));
    module.def(
        "require_light_towards",
        [](const FieldGrid& hologram, const Camera& camera, bool vertical_diffuser) {
            require_light_towards(hologram, camera, vertical_diffuser);
        },
        arg("hologram"), arg("camera"), arg("vertical_diffuser") = false);
    module.def(
        "choose_band_source",
        [](const LightField& light_field, const HologramRequest& request, const std::vector<Camera>& cameras,
           const CameraModel& model) {
            const BandSourceChoice choice = choose_band_source(light_field.grids(), request, cameras, model);
            return py::make_tuple(choice.source, choice.reason);
        },
        arg("light_field"), arg("request"), arg("cameras"), arg("model"));
}

}  // namespace hogel::python
