// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>
#include <string_view>

#include "hogel/export.h"

namespace hogel {

/// Literals for lengths (in metres) and angles (in radians): 633_nm, 5_cm, 40_deg. The library uses metres and radians
/// everywhere.
namespace literals {
constexpr double operator""_m(long double v) { return static_cast<double>(v); }
constexpr double operator""_cm(long double v) { return static_cast<double>(v * 1e-2L); }
constexpr double operator""_mm(long double v) { return static_cast<double>(v * 1e-3L); }
constexpr double operator""_um(long double v) { return static_cast<double>(v * 1e-6L); }
constexpr double operator""_nm(long double v) { return static_cast<double>(v * 1e-9L); }
constexpr double operator""_m(unsigned long long v) { return static_cast<double>(v); }
constexpr double operator""_cm(unsigned long long v) { return static_cast<double>(v) * 1e-2; }
constexpr double operator""_mm(unsigned long long v) { return static_cast<double>(v) * 1e-3; }
constexpr double operator""_um(unsigned long long v) { return static_cast<double>(v) * 1e-6; }
constexpr double operator""_nm(unsigned long long v) { return static_cast<double>(v) * 1e-9; }
constexpr double operator""_deg(long double v) { return static_cast<double>(v) * std::numbers::pi / 180; }
constexpr double operator""_deg(unsigned long long v) { return static_cast<double>(v) * std::numbers::pi / 180; }
}  // namespace literals

/// Parses a length with a unit, such as "16mm", "-0.5 um", "633nm", "1.2m" or "5cm". Returns metres. Micrometres are um
/// or µm. Throws Error(usage) if the text is not a number with a known unit. The message begins with `what`, the name
/// of the quantity, and shows the expected form.
HOGEL_API double parse_length(std::string_view text, std::string_view what);

/// Parses an angle, such as "40deg" or "0.7rad". Returns radians. Throws Error(usage) as parse_length() does.
HOGEL_API double parse_angle(std::string_view text, std::string_view what);

/// Formats a length with a suitable unit: "16 mm", "1.5625 um", "633 nm".
HOGEL_API std::string format_length(double metres);

/// Formats a number of bytes with a suitable decimal unit and two or three digits: "983 MB", "1.4 GB".
HOGEL_API std::string format_bytes(double bytes);

/// Formats a duration with a suitable unit, seconds to years, and two or three digits: "0.5 s", "12 minutes", "3 days".
HOGEL_API std::string format_duration(double seconds);

}  // namespace hogel
