// SPDX-License-Identifier: Apache-2.0
// Fields of other programs, recorded holograms, and where they are in focus.
#include "core.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/focus.h"
#include "hogel/reconstruct.h"

namespace hogel::python {
namespace {

using py::arg;
using Source = std::shared_ptr<const FieldSource>;

void add_external_fields(py::module_& module) {
    py::class_<ExternalField> field(module, "ExternalField");
    py::enum_<ExternalField::Values>(field, "Values")
        .value("complex", ExternalField::Values::complex)
        .value("amplitude", ExternalField::Values::amplitude)
        .value("phase", ExternalField::Values::phase);
    field.def(py::init<>())
        .def_readwrite("pitch_x", &ExternalField::pitch_x)
        .def_readwrite("pitch_y", &ExternalField::pitch_y)
        .def_readwrite("wavelength", &ExternalField::wavelength)
        .def_readwrite("values", &ExternalField::values)
        .def_readwrite("phase_code", &ExternalField::phase_code)
        .def_readwrite("imaginary", &ExternalField::imaginary)
        .def_readwrite("phases", &ExternalField::phases)
        .def_readwrite("zero", &ExternalField::zero)
        .def_readwrite("variable", &ExternalField::variable)
        .def_readwrite("conjugate", &ExternalField::conjugate)
        .def_readwrite("colour", &ExternalField::colour);
    py::class_<ExternalFacts>(module, "ExternalFacts")
        .def_readonly("format", &ExternalFacts::format)
        .def_readonly("numbers", &ExternalFacts::numbers)
        .def_readonly("width", &ExternalFacts::width)
        .def_readonly("height", &ExternalFacts::height)
        .def_readonly("colours", &ExternalFacts::colours)
        .def_readonly("pitch_x", &ExternalFacts::pitch_x)
        .def_readonly("pitch_y", &ExternalFacts::pitch_y)
        .def_readonly("wavelengths", &ExternalFacts::wavelengths)
        .def_readonly("complaint", &ExternalFacts::complaint);
    module.def(
        "external_facts",
        [](const std::filesystem::path& path, const ExternalField& what) {
            return run_for(py::none(), [&](const Progress&) { return external_facts(path, what); });
        },
        arg("path"), arg("what"));
    module.def(
        "open_external_field",
        [](const std::filesystem::path& path, const ExternalField& what) {
            return run_for(py::none(), [&](const Progress&) { return open_external_field(path, what); });
        },
        arg("path"), arg("what"));
    module.def("is_external_field", &is_external_field, arg("path"), py::call_guard<py::gil_scoped_release>());
}

void add_focus(py::module_& module) {
    py::class_<FocusPlane>(module, "FocusPlane")
        .def_readonly("depth", &FocusPlane::depth)
        .def_readonly("prominence", &FocusPlane::prominence)
        .def_readonly("brightest", &FocusPlane::brightest)
        .def_readonly("cell", &FocusPlane::cell);
    py::class_<FocusSearch>(module, "FocusSearch")
        .def_readonly("depths", &FocusSearch::depths)
        .def_readonly("contrasts", &FocusSearch::contrasts)
        .def_readonly("depth_of_focus", &FocusSearch::depth_of_focus)
        .def_readonly("planes", &FocusSearch::planes);
    module.def(
        "find_focus",
        [](const Source& field, double from, double to, std::size_t planes, std::size_t max_side,
           const py::object& report) {
            return run_for(report, [&](const Progress& p) {
                return find_focus(*field, {from, to, planes, max_side}, p);
            });
        },
        arg("field"), arg("from_"), arg("to"), arg("planes"), arg("max_side"), arg("report"));
}

}  // namespace

void add_elsewhere(py::module_& module) {
    add_external_fields(module);
    add_focus(module);
}

}  // namespace hogel::python
