// SPDX-License-Identifier: Apache-2.0
#pragma once

// Points and colours are tuples of three numbers.

#include <array>

#include "core.h"
#include "hogel/geometry.h"

namespace hogel::python {

using Point = std::array<double, 3>;
using Colour = std::array<float, 3>;

inline Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point point_of(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Rgb rgb_of(const Colour& c) { return {c[0], c[1], c[2]}; }
inline Colour colour_of(const Rgb& c) { return {c.r, c.g, c.b}; }

/// A property of type Vec3 as a tuple of three numbers.
template <class Class, class Struct>
void add_vector(Class& to, const char* name, Vec3 Struct::*member) {
    to.def_property(
        name, [member](const Struct& s) { return point_of(s.*member); },
        [member](Struct& s, const Point& p) { s.*member = vector_of(p); });
}
/// A property of type Rgb, likewise.
template <class Class, class Struct>
void add_colour(Class& to, const char* name, Rgb Struct::*member) {
    to.def_property(
        name, [member](const Struct& s) { return colour_of(s.*member); },
        [member](Struct& s, const Colour& c) { s.*member = rgb_of(c); });
}
/// A property of type std::optional<Vec3>; None: there is none.
template <class Class, class Struct>
void add_vector(Class& to, const char* name, std::optional<Vec3> Struct::*member) {
    to.def_property(
        name, [member](const Struct& s) { return s.*member ? std::optional(point_of(*(s.*member))) : std::nullopt; },
        [member](Struct& s, const std::optional<Point>& p) {
            s.*member = p ? std::optional(vector_of(*p)) : std::nullopt;
        });
}
template <class Class, class Struct>
void add_colour(Class& to, const char* name, std::optional<Rgb> Struct::*member) {
    to.def_property(
        name, [member](const Struct& s) { return s.*member ? std::optional(colour_of(*(s.*member))) : std::nullopt; },
        [member](Struct& s, const std::optional<Colour>& c) {
            s.*member = c ? std::optional(rgb_of(*c)) : std::nullopt;
        });
}

}  // namespace hogel::python
