// SPDX-License-Identifier: Apache-2.0
// Errors, units, optional parts and resources of the library.
#include "hogel/units.h"

#include "core.h"
#include "hogel/error.h"
#include "hogel/parameters.h"
#include "hogel/parts.h"
#include "hogel/phase_code.h"
#include "hogel/pipeline.h"
#include "hogel/printable.h"
#include "hogel/resources.h"
#include "hogel/table.h"

namespace hogel::python {

void add_errors(py::module_&) {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            const py::object errors = py::module_::import("hogel.errors");
            const py::object raised =
                errors.attr("of")(static_cast<int>(error.code()), printable(error.what()), error.parameter());
            PyErr_SetObject(py::type::handle_of(raised).ptr(), raised.ptr());
        }
    });
}

void add_units(py::module_& module) {
    using py::arg;
    module.def("parse_length", &parse_length, arg("text"), arg("what"));
    module.def("parse_angle", &parse_angle, arg("text"), arg("what"));
    module.def("printable", &printable, arg("text"));
    module.def("format_length", &format_length, arg("metres"));
    module.def("length_text", &length_text, arg("metres"));
    module.def("angle_text", &angle_text, arg("radians"));
    module.def("channel_of", &channel_of, arg("wavelength"));
    module.def("format_bytes", &format_bytes, arg("bytes"));
    module.def("format_duration", &format_duration, arg("seconds"));
    module.def(
        "throw_unknown",
        [](const std::string& kind, const std::string& name, const std::vector<std::string>& known,
           const std::string& parameter) { throw_unknown(kind, name, known, parameter); },
        arg("kind"), arg("name"), arg("known"), arg("parameter"));
    module.def(
        "throw_known", [](const std::string& kind, const std::string& name) { throw_known(kind, name); }, arg("kind"),
        arg("name"));
    module.def(
        "nearest_word",
        [](const std::string& word, const std::vector<std::string>& words) { return nearest_word(word, words); },
        arg("word"), arg("words"));
    module.def("parts", [] {
        py::list rows;
        for (const Part& part : parts()) rows.append(py::make_tuple(part.name, part.text, part.option, part.built_in));
        return rows;
    });
    module.def("thread_count", &thread_count);
    py::class_<ThreadLimit>(module, "ThreadLimit").def(py::init<std::size_t>(), arg("threads"));

    const auto named = [&](const char* name, const auto& value) { module.attr(name) = value; };
    py::dict values;
    values["renderer"] = std::string(defaults.renderer);
    values["shading"] = std::string(defaults.shading);
    values["shadow_map"] = defaults.shadow_map;
    values["cache_spacing"] = defaults.cache_spacing;
    values["size"] = defaults.size;
    values["hogels"] = defaults.hogels;
    values["directions"] = defaults.directions;
    values["field_of_view"] = defaults.field_of_view;
    values["front"] = defaults.front;
    values["sqnr"] = defaults.sqnr;
    values["tone_decades"] = defaults.tone_decades;
    values["bake_rays"] = defaults.bake_rays;
    values["bake_bounces"] = defaults.bake_bounces;
    values["pitch"] = defaults.pitch;
    values["basis"] = std::string(defaults.basis);
    values["spacing"] = defaults.spacing;
    values["planes"] = defaults.planes;
    values["red"] = defaults.red;
    values["green"] = defaults.green;
    values["blue"] = defaults.blue;
    values["eye_distance"] = defaults.eye_distance;
    values["pupil"] = defaults.pupil;
    values["focal_length"] = defaults.focal_length;
    values["frame_rate"] = defaults.frame_rate;
    values["resolution"] = defaults.resolution;
    values["looks"] = defaults.looks;
    values["pupil_samples"] = defaults.pupil_samples;
    named("defaults", values);

    py::enum_<InputKind>(module, "InputKind")
        .value("scene", InputKind::scene)
        .value("light_field", InputKind::light_field)
        .value("hologram", InputKind::hologram);
    py::enum_<FileKind>(module, "FileKind")
        .value("light_field", FileKind::light_field)
        .value("hologram", FileKind::hologram)
        .value("picture", FileKind::picture)
        .value("mesh", FileKind::mesh)
        .value("unknown", FileKind::unknown);
    module.def(
        "input_kind",
        [](const std::string& name) { return run_for(py::none(), [&](const Progress&) { return input_kind(name); }); },
        arg("name"));
    module.def("file_kind", &file_kind, arg("path"), py::call_guard<py::gil_scoped_release>());
    module.def("file_formats", [] { return file_formats().names(); });
    module.def(
        "summarize",
        [](const std::filesystem::path& path) {
            const auto summary = run_for(py::none(), [&](const Progress&) { return summarize(path); });
            return py::make_tuple(summary.kind, summary.text, summary.numbers);
        },
        arg("path"));
    module.def(
        "require_writable",
        [](const std::filesystem::path& file, const std::vector<std::string>& inputs) {
            require_writable(file, inputs);
        },
        arg("file"), arg("inputs") = std::vector<std::string>());
    module.def(
        "require_name", [](const std::filesystem::path& p, const std::string& f) { require_name(p, f); }, arg("path"),
        arg("format"));
    module.def("require_hdf5", &require_hdf5, arg("path"));
}

}  // namespace hogel::python
