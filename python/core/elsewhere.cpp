// SPDX-License-Identifier: Apache-2.0
// Fields of other programs, recorded holograms, and focus search.
#include "core.h"
#include "hogel/field.h"
#include "hogel/files.h"
#include "hogel/focus.h"
#include "hogel/reconstruct.h"
#include "hogel/requests.h"
#include "keywords.h"

namespace hogel::python {
namespace {

using py::arg;
using Source = std::shared_ptr<const FieldSource>;

// Parameters of Hologram.open(), from keywords.
struct FieldKeywords {
    FieldParameters values;
    Parameters table;

    explicit FieldKeywords(const py::dict& keywords = {}) {
        values.declare(table, true, true);
        values.declare_reconstruction(table);
        if (keywords.contains("phase_code") && py::isinstance<PhaseCode>(keywords["phase_code"])) {
            const auto code = keywords["phase_code"].cast<PhaseCode>();
            if (parse_phase_code(phase_code_text(code)) != code) values.own_code = code;
        }
        read_keywords(table, keywords);
    }
};

void add_openers(py::module_& module) {
    module.def("field_keywords", [] {
        const FieldKeywords defaults;
        return described(defaults.table);
    });
    module.def(
        "open_fields",
        [](const py::dict& keywords, const std::string& name, const py::object& report) {
            FieldKeywords parsed(keywords);
            const OpenedFields opened = run_for(
                report, [&](const Progress& p) { return parsed.values.open_and_reconstruct(name, parsed.table, p); });
            return py::make_tuple(opened.fields, parsed.table.acting());
        },
        arg("keywords"), arg("name"), arg("report"), "Returns the fields of a file, and the options that acted.");
}

void add_external_fields(py::module_& module) {
    py::class_<ExternalField> field(module, "ExternalField");
    py::enum_<ExternalField::Values>(field, "Values")
        .value("complex", ExternalField::Values::complex)
        .value("amplitude", ExternalField::Values::amplitude)
        .value("phase", ExternalField::Values::phase)
        .value("real_imaginary", ExternalField::Values::real_imaginary)
        .value("amplitude_phase", ExternalField::Values::amplitude_phase);
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
        .def_readwrite("reflectance", &ExternalField::reflectance)
        .def_readwrite("colour", &ExternalField::colour)
        .def_readwrite("panel", &ExternalField::panel)
        .def_readwrite("largest", &ExternalField::largest);
    py::class_<ExternalFacts>(module, "ExternalFacts")
        .def_readonly("format", &ExternalFacts::format)
        .def_readonly("numbers", &ExternalFacts::numbers)
        .def_readonly("width", &ExternalFacts::width)
        .def_readonly("height", &ExternalFacts::height)
        .def_readonly("colours", &ExternalFacts::colours)
        .def_readonly("pitch_x", &ExternalFacts::pitch_x)
        .def_readonly("pitch_y", &ExternalFacts::pitch_y)
        .def_readonly("wavelengths", &ExternalFacts::wavelengths)
        .def_readonly("complaint", &ExternalFacts::complaint)
        .def_readonly("values", &ExternalFacts::values)
        .def_readonly("phase_code", &ExternalFacts::phase_code)
        .def_readonly("panel", &ExternalFacts::panel)
        .def_readonly("largest", &ExternalFacts::largest);
    module.def(
        "external_facts",
        [](const std::filesystem::path& path, const ExternalField& description) {
            return run_for(py::none(), [&](const Progress&) { return external_facts(path, description); });
        },
        arg("path"), arg("what"));
    module.def(
        "open_external_field",
        [](const std::filesystem::path& path, const ExternalField& description) {
            return run_for(py::none(), [&](const Progress&) { return open_external_field(path, description); });
        },
        arg("path"), arg("what"));
    module.def(
        "field_entries",
        [](const ExternalField& description, const std::vector<double>& wavelengths) {
            return field_entries(description, wavelengths);
        },
        arg("what"), arg("wavelengths"));
    module.def("is_external_field", &is_external_field, arg("path"), py::call_guard<py::gil_scoped_release>());
}

void add_focus(py::module_& module) {
    py::class_<FocusPlane>(module, "FocusPlane")
        .def_readonly("depth", &FocusPlane::depth)
        .def_readonly("prominence", &FocusPlane::prominence)
        .def_readonly("brightest", &FocusPlane::brightest)
        .def_readonly("cell", &FocusPlane::cell);
    py::class_<FocusSearch>(module, "FocusSearch")
        .def_property_readonly(
            "cells",
            [](const FocusSearch&) { return std::vector(FocusSearch::cells.begin(), FocusSearch::cells.end()); })
        .def_property_readonly("edges", [](const FocusSearch&) { return FocusSearch::edges; })
        .def_readonly("light_depth_of_focus", &FocusSearch::light_depth_of_focus)
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
    module.def(
        "focus_region",
        [](const FieldGrid& grid, std::size_t width, std::size_t height) {
            FocusOptions options;
            options.width = width;
            options.height = height;
            const Region region = focus_region(grid, options);
            return py::make_tuple(region.x0, region.y0, region.width, region.height);
        },
        arg("grid"), arg("width") = 0, arg("height") = 0);
}

void add_orders(py::module_& module) {
    py::class_<OrderSelection> selection(module, "OrderSelection");
    py::enum_<OrderSelection::Which>(selection, "Which")
        .value("center", OrderSelection::Which::center)
        .value("right", OrderSelection::Which::right)
        .value("left", OrderSelection::Which::left)
        .value("at", OrderSelection::Which::at);
    selection.def(py::init<>())
        .def_readwrite("without_mean", &OrderSelection::without_mean)
        .def_property(
            "reference_source",
            [](const OrderSelection& s) {
                return s.reference_source ? std::optional(std::array{s.reference_source->x, s.reference_source->y,
                                                                     s.reference_source->z})
                                          : std::nullopt;
            },
            [](OrderSelection& s, const std::optional<std::array<double, 3>>& position) {
                s.reference_source.reset();
                if (position) s.reference_source = Vec3{(*position)[0], (*position)[1], (*position)[2]};
            })
        .def_readwrite("which", &OrderSelection::which)
        .def_readwrite("frequency_x", &OrderSelection::frequency_x)
        .def_readwrite("frequency_y", &OrderSelection::frequency_y)
        .def_readwrite("radius", &OrderSelection::radius);
    module.def(
        "select_order",
        [](const Source& hologram, const OrderSelection& order, const py::object& report) {
            auto selected = run_for(report, [&](const Progress& p) { return select_order(*hologram, order, p); });
            Source field = std::make_shared<const Field>(std::move(selected.field));
            return py::make_tuple(std::move(field), selected.frequency_x, selected.frequency_y, selected.radius);
        },
        arg("hologram"), arg("selection"), arg("report"));
}

}  // namespace

void add_elsewhere(py::module_& module) {
    add_external_fields(module);
    add_openers(module);
    add_focus(module);
    add_orders(module);
}

}  // namespace hogel::python
