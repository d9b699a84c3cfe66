// SPDX-License-Identifier: Apache-2.0
#include "keywords.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "hogel/error.h"
#include "hogel/phase_code.h"

namespace hogel::python {
namespace {

// Returns str(value), or ascii(value) if UTF-8 cannot encode the former.
std::string utf8_text(const py::handle& value) {
    for (const auto say : {PyObject_Str, PyObject_ASCII}) {
        const auto text = py::reinterpret_steal<py::object>(say(value.ptr()));
        const char* const bytes = text ? PyUnicode_AsUTF8(text.ptr()) : nullptr;
        if (bytes != nullptr) return bytes;
        PyErr_Clear();
    }
    return Py_TYPE(value.ptr())->tp_name;
}

bool is_boolean(const py::handle& value) {
    const std::string_view type = Py_TYPE(value.ptr())->tp_name;
    return type == "bool" || type == "numpy.bool_" || type == "numpy.bool";
}

// Returns whether a value is a sequence. Bytes are not, and a 0-dimensional array is a number.
bool is_list(const py::handle& value) {
    if (PyBytes_Check(value.ptr()) || PyByteArray_Check(value.ptr()) || PyMemoryView_Check(value.ptr())) return false;
    if (PySequence_Check(value.ptr()) != 0 && PySequence_Size(value.ptr()) >= 0) return true;
    PyErr_Clear();
    return false;
}

// Returns the value as a number, or nothing. The caller then passes its text to the parameter, which reports the error.
std::optional<double> number_of(const py::handle& value) {
    if (is_boolean(value)) return {};
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    PyErr_Clear();
    return {};
}

std::string whole_text(const py::handle& value) {
    if (is_boolean(value)) return utf8_text(value);
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    PyErr_Clear();
    return utf8_text(whole ? whole : value);
}

// Converts one element: a number, a text, a path, or a phase code.
std::string element_text(ParameterKind kind, const py::handle& value) {
    if (py::isinstance<py::str>(value)) return utf8_text(value);
    if (py::isinstance<PhaseCode>(value)) return phase_code_text(value.cast<PhaseCode>());
    if (py::hasattr(value, "__fspath__")) return utf8_text(value.attr("__fspath__")());
    if (kind == ParameterKind::counts || kind == ParameterKind::resolution) return whole_text(value);
    const std::optional<double> number = number_of(value);
    if (!number || !std::isfinite(*number)) return utf8_text(value);
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
    // With one common unit, like the command line.
    if (kind == ParameterKind::angles && texts.size() == 2 && numbers.size() == 2)
        return angles_text({numbers[0], numbers[1]});
    if (kind == ParameterKind::point && texts.size() == 3 && numbers.size() == 3)
        return point_text({numbers[0], numbers[1], numbers[2]});
    if (kind == ParameterKind::rotation && texts.size() == 3 && numbers.size() == 3)
        return rotation_text({numbers[0], numbers[1], numbers[2]});
    const bool counts = kind == ParameterKind::counts || kind == ParameterKind::resolution;
    return fmt::format("{}", fmt::join(texts, counts ? "x" : ","));
}

std::string flag_text(const py::handle& value) {
    const std::string text = is_boolean(value) ? utf8_text(value) : whole_text(value);
    return text == "True" || text == "1" ? "yes" : text == "False" || text == "0" ? "no" : text;
}

// Converts a Python value to the text of the command line.
std::string text_of(ParameterKind kind, const py::handle& value) {
    if (py::isinstance<py::str>(value)) return utf8_text(value);
    switch (kind) {
        case ParameterKind::flag:
            return flag_text(value);
        case ParameterKind::count:
        case ParameterKind::whole:
            return whole_text(value);
        case ParameterKind::number:
            if (const auto number = number_of(value)) return fmt::format("{}", *number);
            return utf8_text(value);
        case ParameterKind::texts:
            return is_list(value) ? utf8_text(py::str(" ").attr("join")(value)) : utf8_text(value);
        case ParameterKind::choice:
            return utf8_text(value);
        default:
            return is_list(value) ? list_text(kind, value) : element_text(kind, value);
    }
}

// Sets a parameter, unless it is a flag with the value "no". Errors contain its name.
void read(Parameter& parameter, const std::string& name, const py::handle& value) {
    const std::string text = text_of(parameter.kind, value);
    if (parameter.kind == ParameterKind::flag && text == "no") return;
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
        if (!value.is_none()) read(parameter, name, value);
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
