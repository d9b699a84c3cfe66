// SPDX-License-Identifier: Apache-2.0
// Holograms: computed from light fields and scenes, and in files.
#include "hogel/hologram.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "core.h"
#include "hogel/pipeline.h"
#include "hogel/scene_hologram.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;

void add_methods(py::module_& module) {
    py::enum_<Phases>(module, "Phases")
        .value("random", Phases::random)
        .value("fixed", Phases::fixed)
        .value("designed", Phases::designed);
    py::enum_<SharedPhases>(module, "SharedPhases")
        .value("fixed", SharedPhases::fixed)
        .value("designed", SharedPhases::designed);
    py::enum_<PointPhases>(module, "PointPhases")
        .value("random", PointPhases::random)
        .value("fixed", PointPhases::fixed);
    py::enum_<LobeAverage>(module, "LobeAverage")
        .value("radiance", LobeAverage::radiance)
        .value("amplitude", LobeAverage::amplitude);
    py::class_<Fourier>(module, "Fourier")
        .def(py::init<>())
        .def_readwrite("phases", &Fourier::phases)
        .def_readwrite("average", &Fourier::average);
    py::class_<Lines>(module, "Lines")
        .def(py::init<>())
        .def_readwrite("line_pitch", &Lines::line_pitch)
        .def_readwrite("phases", &Lines::phases)
        .def_readwrite("average", &Lines::average);
    py::class_<Basis>(module, "Basis")
        .def(py::init<>())
        .def_readwrite("transform", &Basis::transform)
        .def_readwrite("tolerance", &Basis::tolerance)
        .def_readwrite("phases", &Basis::phases)
        .def_readwrite("line_pitch", &Basis::line_pitch);
    py::class_<PhaseAdded>(module, "PhaseAdded").def(py::init<>()).def_readwrite("exact", &PhaseAdded::exact);
    py::class_<OverlapAdd>(module, "OverlapAdd").def(py::init<>()).def_readwrite("phases", &OverlapAdd::phases);
    py::class_<OwnMethod>(module, "OwnMethod").def_readonly("name", &OwnMethod::name);
    module.def("hologram_methods", [] { return hologram_methods().names(); });
    module.def(
        "hologram_method", [](const std::string& name) { return hologram_methods().find(name).method; }, arg("name"));
    const auto pairs_of = [](const std::vector<Channel>& channels) {
        std::vector<std::pair<double, std::size_t>> pairs;
        for (const Channel& c : channels) pairs.emplace_back(c.wavelength, c.index);
        return pairs;
    };
    module.def(
        "mono", [pairs_of](double wavelength) { return pairs_of(mono(wavelength)); }, arg("wavelength"));
    module.def(
        "rgb", [pairs_of](double red, double green, double blue) { return pairs_of(rgb(red, green, blue)); },
        arg("red"), arg("green"), arg("blue"));
    module.def("line_pitch", &line_pitch, arg("method"));
    module.def("needs_depth", &needs_depth, arg("method"));
}

// Parameters of Scene.hologram(), from keywords.
struct SceneHologramKeywords {
    std::uint64_t seed = 1;
    HologramParameters hologram;
    LightFieldParameters place;
    Parameters table;

    explicit SceneHologramKeywords(const py::dict& keywords) {
        table.whole("--seed", seed, std::numeric_limits<std::uint64_t>::max(), "");
        hologram.declare_with_scene_methods(table);
        place.declare(table);
        place.declare_hemicube(table);
        read_keywords(table, keywords);
        place.cache_spacing = 0;  // in ray widths; this method has no rays
    }

    SceneHologramRequest request() const { return hologram.scene_request(seed, place); }
};

// Returns whether a parameter is a keyword of Scene.hologram(). The method itself is a separate argument.
bool is_of_scene_holograms(const Parameter& each) {
    constexpr std::array<std::string_view, 4> own{"wavelength", "pitch", "spacing", "planes"};
    return each.group == "Hologram" ? std::ranges::count(own, each.name) > 0
                                    : each.group != "Scene" && each.name != "fit";
}

Metadata scene_hologram_record(const py::dict& keywords, const Scene& placed, bool is_file) {
    SceneHologramKeywords asked(keywords);
    asked.place.scene.resolve(placed, is_file);
    asked.place.scene.has_background = false;  // only surfaces emit light
    asked.place.resolve(placed);
    asked.hologram.resolve(scene_hologram_methods().find(asked.hologram.method));
    return asked.table.acting();
}

std::vector<std::shared_ptr<const FieldSource>> make_scene_holograms(const SceneHologramRequest& request,
                                                                     const ShadedScene& scene,
                                                                     const Progress& progress) {
    const SceneHologramMethod& method = scene_hologram_methods().find(request.method);
    std::vector<std::shared_ptr<const FieldSource>> fields;
    for (std::size_t i = 0; i < request.grids.size(); ++i)
        fields.push_back(std::make_shared<const Field>(
            method.make(scene, request.grids[i], request.options[i], progress.part(i, request.grids.size()))));
    return fields;
}

void add_scene_holograms(py::module_& module) {
    module.def("scene_hologram_methods", [] {
        std::vector<std::pair<std::string, std::string>> rows;
        for (const SceneHologramMethod& row : scene_hologram_methods().rows()) rows.emplace_back(row.name, row.text);
        return rows;
    });
    module.def("scene_hologram_keywords",
               [] { return described(SceneHologramKeywords{py::dict()}.table, is_of_scene_holograms); });
    module.def(
        "scene_hologram_place",
        [](const py::dict& keywords) {
            const SceneHologramKeywords asked(keywords);
            static_cast<void>(asked.request());  // throws before a scene is loaded
            return asked.place.request();
        },
        arg("keywords"));
    module.def("scene_hologram_record", &scene_hologram_record, arg("keywords"), arg("placed"), arg("is_file"));
    module.def(
        "make_scene_holograms",
        [](const py::dict& keywords, const std::shared_ptr<ShadedScene>& scene, const py::object& report) {
            const SceneHologramRequest request = SceneHologramKeywords(keywords).request();
            return run_for(report, [&](const Progress& p) { return make_scene_holograms(request, *scene, p); });
        },
        arg("keywords"), arg("scene"), arg("report"));
}

}  // namespace

void add_holograms(py::module_& module) {
    add_methods(module);
    add_scene_holograms(module);
    py::class_<HologramRequest>(module, "HologramRequest")
        .def(py::init<>())
        .def_property(
            "channels",
            [](const HologramRequest& r) {
                std::vector<std::pair<double, std::size_t>> channels;
                for (const Channel& c : r.channels) channels.emplace_back(c.wavelength, c.index);
                return channels;
            },
            [](HologramRequest& r, const std::vector<std::pair<double, std::size_t>>& channels) {
                r.channels.clear();
                for (const auto& [wavelength, index] : channels) r.channels.push_back({wavelength, index});
            })
        .def_readwrite("pitch", &HologramRequest::pitch)
        .def_readwrite("method", &HologramRequest::method)
        .def_readwrite("looks", &HologramRequest::looks)
        .def_readwrite("seed", &HologramRequest::seed)
        .def_readonly("of_coefficients", &HologramRequest::of_coefficients);
    module.def(
        "require_holograms",
        [](const LightField& light_field, const HologramRequest& request, const std::vector<Camera>& cameras) {
            require_holograms(light_field.grids(), request, cameras);
        },
        arg("light_field"), arg("request"), arg("cameras") = std::vector<Camera>());
    const auto options_of = [](const LightField& light_field, const HologramRequest& request, std::size_t number) {
        if (number >= request.channels.size())
            throw Error(ErrorCode::usage, "number: " + std::to_string(number) + " of " +
                                              std::to_string(request.channels.size()) + " wavelengths was asked for");
        return request.options(request.channels[number], light_field.grids());
    };
    module.def(
        "hologram_grid",
        [options_of](const LightField& light_field, const HologramRequest& request, std::size_t number) {
            return hologram_grid(light_field.grids(), options_of(light_field, request, number));
        },
        arg("light_field"), arg("request"), arg("number") = 0);
    module.def(
        "make_hologram",
        [options_of](const LightField& light_field, const HologramRequest& request, std::size_t number) {
            const HologramOptions options = options_of(light_field, request, number);
            return run_for(py::none(), [&](const Progress&) { return make_hologram(light_field, options); });
        },
        arg("light_field"), arg("request"), arg("number") = 0);
    module.def(
        "make_hologram_of_coefficients",
        [options_of](const LightField& coefficients, const HologramRequest& request, std::size_t number) {
            const HologramOptions options = options_of(coefficients, request, number);
            return run_for(py::none(),
                           [&](const Progress&) { return make_hologram_of_coefficients(coefficients, options); });
        },
        arg("coefficients"), arg("request"), arg("number") = 0);
    module.def("warning_about", &warning_about, arg("light_field"), arg("request"),
               py::call_guard<py::gil_scoped_release>());
    module.def(
        "make_holograms",
        [](const LightField& light_field, const HologramRequest& request) {
            return run_for(py::none(), [&](const Progress&) { return make_holograms(light_field, request); });
        },
        arg("light_field"), arg("request"));
    module.def(
        "open_for_holograms",
        [](const std::filesystem::path& path, HologramRequest& request, bool any_transform) {
            return run_for(py::none(),
                           [&](const Progress&) { return open_for_holograms(path, request, any_transform); });
        },
        arg("path"), arg("request"), arg("any_transform"));
    module.def(
        "open_hologram",
        [](const std::filesystem::path& path) {
            return run_for(py::none(), [&](const Progress&) { return open_hologram(path); });
        },
        arg("path"));
    module.def(
        "write_holograms",
        [](const std::filesystem::path& path, const Fields& holograms, bool half, const py::object& metadata,
           const std::optional<std::string>& resume, const py::object& report) {
            HologramFileOptions options;
            options.type = half ? SampleType::half : SampleType::single;
            options.metadata = metadata_of(metadata);
            options.resume = resume;
            run(report, [&](const Progress& p) { write_holograms(path, holograms, options, p); });
        },
        arg("path"), arg("holograms"), arg("half"), arg("metadata"), arg("resume"), arg("report"));
    module.def("require_fields_name", &require_fields_name, arg("path"));
    module.def(
        "write_fields",
        [](const std::filesystem::path& path, const Fields& fields, const py::object& metadata,
           const py::object& report) {
            const Metadata entries = metadata_of(metadata);
            run(report, [&](const Progress& p) {
                std::vector<Field> loaded;
                for (std::size_t i = 0; i < fields.size(); ++i) {
                    loaded.emplace_back(fields[i]->grid());
                    copy(*fields[i], loaded.back(), 0, p.part(i, fields.size()));
                }
                write_fields(path, loaded, entries);
            });
        },
        arg("path"), arg("fields"), arg("metadata"), arg("report"));
    module.def(
        "compare_fields",
        [](const Fields& a, const Fields& b, const py::object& report) {
            const auto c = run_for(report, [&](const Progress& p) { return compare(a, b, p); });
            return py::make_tuple(c.sqnr, c.psnr, c.max_error);
        },
        arg("a"), arg("b"), arg("report"));
}

}  // namespace hogel::python
