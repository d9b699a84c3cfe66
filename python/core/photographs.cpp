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
    py::enum_<LightFrom>(module, "LightFrom")
        .value("cheaper", LightFrom::cheaper)
        .value("hogels", LightFrom::hogels)
        .value("samples", LightFrom::samples);
    py::class_<PhotographOptions>(module, "PhotographOptions")
        .def(py::init<>())
        .def_readwrite("memory", &PhotographOptions::memory)
        .def_readwrite("from_", &PhotographOptions::from)
        .def_readwrite("expected", &PhotographOptions::expected)
        .def_readwrite("vertical_diffuser", &PhotographOptions::vertical_diffuser)
        .def_readwrite("preview", &PhotographOptions::preview);
    py::class_<PlaneWaveCameraOptions>(module, "PlaneWaveCameraOptions")
        .def(py::init([](std::size_t memory, const std::filesystem::path& folder, double film_distance) {
                 return PlaneWaveCameraOptions{{memory, folder}, film_distance};
             }),
             arg("memory") = ScratchOptions().memory, arg("folder") = std::filesystem::path(),
             arg("film_distance") = 0.0)
        .def_property(
            "memory", [](const PlaneWaveCameraOptions& o) { return o.scratch.memory; },
            [](PlaneWaveCameraOptions& o, std::size_t bytes) { o.scratch.memory = bytes; })
        .def_property(
            "folder", [](const PlaneWaveCameraOptions& o) { return o.scratch.folder; },
            [](PlaneWaveCameraOptions& o, const std::filesystem::path& folder) { o.scratch.folder = folder; })
        .def_readwrite("film_distance", &PlaneWaveCameraOptions::film_distance);
    module.def(
        "photograph_colours",
        [](const Fields& holograms, const std::vector<Camera>& cameras, const WaveCamera& with,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) { return photograph_colours(holograms, cameras, with, p); });
        },
        arg("holograms"), arg("cameras"), arg("with_"), arg("report"));
    module.def(
        "photograph_rays",
        [](const LightField& light_field, const std::vector<Camera>& cameras, std::size_t pupil_samples,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) {
                return photograph(light_field, cameras, RayPhotographOptions{pupil_samples}, p);
            });
        },
        arg("light_field"), arg("cameras"), arg("pupil_samples"), arg("report"));
    module.def(
        "photograph",
        [](const Source& hologram, const std::vector<Camera>& cameras, const PhotographOptions& options,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) { return photograph(*hologram, cameras, options, p); });
        },
        arg("hologram"), arg("cameras"), arg("options"), arg("report"));
    module.def(
        "photograph_by_plane_waves",
        [](const Source& hologram, const std::vector<Camera>& cameras, const PlaneWaveCameraOptions& options,
           const py::object& report) {
            return run_for(
                report, [&](const Progress& p) { return photograph_by_plane_waves(*hologram, cameras, options, p); });
        },
        arg("hologram"), arg("cameras"), arg("options"), arg("report"));
    module.def(
        "require_photographs",
        [](const FieldGrid& hologram, const std::vector<Camera>& cameras, const PhotographOptions& options) {
            require_photographs(hologram, cameras, options);
        },
        arg("hologram"), arg("cameras"), arg("options"));
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
                    return photographer.photograph(camera, RayPhotographOptions{pupil_samples}, p);
                });
            },
            arg("camera"), arg("pupil_samples") = RayPhotographOptions().pupil_samples, arg("report") = py::none());
    py::class_<EyePhotographer>(module, "EyePhotographer")
        .def(py::init([](const Fields& holograms, const PhotographOptions& options, const py::object& report) {
                 return run_for(report, [&](const Progress& p) {
                     return std::make_unique<EyePhotographer>(holograms, options, p);
                 });
             }),
             arg("holograms"), arg("options") = PhotographOptions(), arg("report") = py::none())
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
        "photograph_directly",
        [](const std::shared_ptr<const FieldSource>& hologram, const Camera& camera, std::size_t pupil_points_across,
           std::size_t subpixels) {
            return run_for(py::none(), [&](const Progress&) {
                return photograph_directly(*hologram, camera, pupil_points_across, subpixels);
            });
        },
        arg("hologram"), arg("camera"), arg("pupil_points_across"), arg("subpixels"));
    module.def(
        "require_light_towards",
        [](const FieldGrid& hologram, const Camera& camera, bool vertical_diffuser) {
            require_light_towards(hologram, camera, vertical_diffuser);
        },
        arg("hologram"), arg("camera"), arg("vertical_diffuser") = false);
    module.def(
        "choose_light",
        [](const LightField& light_field, const HologramRequest& request, const std::vector<Camera>& cameras,
           const PhotographOptions& options) {
            const LightChoice choice = choose_light(light_field.grids(), request, cameras, options);
            return py::make_tuple(choice.from, choice.reason);
        },
        arg("light_field"), arg("request"), arg("cameras"), arg("options"));
}

}  // namespace hogel::python
