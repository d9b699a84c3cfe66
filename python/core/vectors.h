// SPDX-License-Identifier: Apache-2.0
#pragma once

// Points and colours are tuples of three numbers.

#include <array>
#include <optional>
#include <type_traits>

#include "core.h"
#include "hogel/geometry.h"

namespace hogel::python {

using Point = std::array<double, 3>;
using Colour = std::array<float, 3>;

inline Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point point_of(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Rgb rgb_of(const Colour& c) { return {c[0], c[1], c[2]}; }
inline Colour colour_of(const Rgb& c) { return {c.r, c.g, c.b}; }

inline std::optional<Point> point_of(const std::optional<Vec3>& v) {
    return v ? std::optional(point_of(*v)) : std::nullopt;
}
inline std::optional<Vec3> vector_of(const std::optional<Point>& p) {
    return p ? std::optional(vector_of(*p)) : std::nullopt;
}
inline std::optional<Colour> colour_of(const std::optional<Rgb>& c) {
    return c ? std::optional(colour_of(*c)) : std::nullopt;
}
inline std::optional<Rgb> rgb_of(const std::optional<Colour>& c) {
    return c ? std::optional(rgb_of(*c)) : std::nullopt;
}

/// Adds a property with conversion: `to_python` for reading, `to_cpp` for writing.
template <class Class, class Struct, class Value, class ToPython, class ToCpp>
void add_converted(Class& to, const char* name, Value Struct::*member, ToPython to_python, ToCpp to_cpp) {
    using Python = std::invoke_result_t<ToPython, const Value&>;
    to.def_property(
        name, [=](const Struct& s) { return to_python(s.*member); },
        [=](Struct& s, const Python& value) { s.*member = to_cpp(value); });
}
/// Adds a property of type Vec3 or std::optional<Vec3> (None if absent) as a tuple of three numbers.
template <class Class, class Struct, class Value>
void add_vector(Class& to, const char* name, Value Struct::*member) {
    add_converted(
        to, name, member, [](const Value& v) { return point_of(v); }, [](const auto& p) { return vector_of(p); });
}
/// Adds a property of type Rgb or std::optional<Rgb> in the same way.
template <class Class, class Struct, class Value>
void add_colour(Class& to, const char* name, Value Struct::*member) {
    add_converted(
        to, name, member, [](const Value& c) { return colour_of(c); }, [](const auto& c) { return rgb_of(c); });
}

}  // namespace hogel::python
