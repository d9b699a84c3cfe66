// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "hogel/geometry.h"

namespace hogel::cli {

/// Columns and rows: "256x256", or "256" for a square.
struct Counts {
    std::size_t columns = 0, rows = 0;
};

/// Across and down, in radians: "40deg" for both, or "40,30deg".
struct Angles {
    double across = 0, down = 0;
};

/// A finite number without a unit, or nothing if the text is not one.
std::optional<double> parse_number(const std::string& text);

/// "0,0,300mm": a component without a unit takes that of the last; and a length, "16mm". Both refuse what is too long
/// to be meant. They throw Error(usage), which begins with `what`.
Vec3 parse_point(const std::string& text, const std::string& what);
double parse_any_length(const std::string& text, const std::string& what);

/// A length as typed: with a unit, and no space before it.
std::string compact_length(double metres);

/// The channel of a picture for light of a wavelength: 0 red, 1 green, 2 blue.
std::size_t colour_of(double wavelength);

}  // namespace hogel::cli
