// SPDX-License-Identifier: Apache-2.0
#include "keywords.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

#include "hogel/error.h"

namespace hogel::python {
namespace {

// Whatever is no number is a text that the parameter refuses by its name.
std::optional<double> number_of(const py::handle& value) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    PyErr_Clear();
    return {};
}

std::string whole_text(const py::handle& value) {
    const py::object whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (whole) return py::str(whole);
    PyErr_Clear();
    return py::str(value);
}

// One number of a parameter, a text, or a path.
std::string element_text(ParameterKind kind, const py::handle& value) {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::hasattr(value, "__fspath__")) return py::str(value.attr("__fspath__")());
    if (kind == ParameterKind::counts || kind == ParameterKind::resolution) return whole_text(value);
    const std::optional<double> number = number_of(value);
    if (!number || !std::isfinite(*number)) return py::str(value);
    if (kind == ParameterKind::text) return fmt::format("{}", *number);
    const bool is_angle =
        kind == ParameterKind::angle || kind == ParameterKind::angles || kind == ParameterKind::rotation;
    return is_angle ? angle_text(*number) : length_text(*number);
}

std::string list_text(ParameterKind kind, const py::handle& values) {
    std::vector<std::string> texts;
    std::vector<double> numbers;
    for (const py::handle value : values) {
        texts.push_back(element_text(kind, value));
        if (const auto number = number_of(value); number && std::isfinite(*number)) numbers.push_back(*number);
    }
    // As the command line writes what all has one unit.
    if (kind == ParameterKind::angles && texts.size() == 2 && numbers.size() == 2)
        return angles_text({numbers[0], numbers[1]});
    if (kind == ParameterKind::point && texts.size() == 3 && numbers.size() == 3)
        return point_text({numbers[0], numbers[1], numbers[2]});
    if (kind == ParameterKind::rotation && texts.size() == 3 && numbers.size() == 3)
        return rotation_text({numbers[0], numbers[1], numbers[2]});
    const bool counts = kind == ParameterKind::counts || kind == ParameterKind::resolution;
    return fmt::format("{}", fmt::join(texts, counts ? "x" : ","));
}

// A value of Python as the command line writes it.
std::string text_of(ParameterKind kind, const py::handle& value) {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    switch (kind) {
        case ParameterKind::flag:
            return py::bool_(py::reinterpret_borrow<py::object>(value)) ? "yes" : "no";
        case ParameterKind::count:
        case ParameterKind::whole:
            return whole_text(value);
        case ParameterKind::number:
            if (const auto number = number_of(value)) return fmt::format("{}", *number);
            return py::str(value);
        case ParameterKind::texts:
            return py::str(" ").attr("join")(value).cast<std::string>();
        case ParameterKind::choice:
            return py::str(value);
        default:
            break;
    }
    return PySequence_Check(value.ptr()) == 0 ? element_text(kind, value) : list_text(kind, value);
}

// Sets a parameter; errors name it.
void read(Parameter& parameter, const std::string& name, const py::handle& value) {
    const std::string text = text_of(parameter.kind, value);
    try {
        parameter.read_value(text, name);
    } catch (const Error& error) {
        throw Error(error.code(), name, error.what());
    }
}

}  // namespace

void read_keywords(Parameters& parameters, const py::dict& keywords) {
    for (Parameter& parameter : parameters.all()) {
        const std::string name = parameter.keyword();
        if (!keywords.contains(name)) continue;
        const py::object value = keywords[name.c_str()];
        if (value.is_none() || value.is(py::bool_(false))) continue;
        read(parameter, name, value);
    }
    parameters.require_compatible();
}

py::list described(const Parameters& table, const std::function<bool(const Parameter&)>& is_wanted) {
    py::list rows;
    for (const Parameter& each : table.all())
        if (is_wanted(each)) rows.append(py::make_tuple(each.keyword(), each.shown_default, each.help));
    return rows;
}

}  // namespace hogel::python
