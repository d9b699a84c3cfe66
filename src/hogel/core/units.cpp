// SPDX-License-Identifier: Apache-2.0
#include "hogel/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "hogel/error.h"

namespace hogel {
namespace {

struct Unit {
    std::string_view name;
    double scale;
    int exponent = 0;  // decimal exponent, in addition to the scale
};

constexpr std::array length_units{Unit{"m", 1},      Unit{"cm", 1, -2},      Unit{"mm", 1, -3}, Unit{"um", 1, -6},
                                  Unit{"µm", 1, -6}, Unit{"\u03bcm", 1, -6}, Unit{"nm", 1, -9}};
constexpr std::array angle_units{Unit{"deg", std::numbers::pi / 180}, Unit{"rad", 1}};

// Returns a number times 10^exponent by moving its decimal point: 460 nm is exactly the double 460e-9, as in a program.
// A product with 1e-9 would not be, because 1e-9 is not a double.
double shifted(std::string_view number, double value, int exponent) {
    if (exponent == 0) return value;
    const std::size_t end = std::min(number.find_first_of("eE"), number.size());
    std::string_view digits = number.substr(std::min(end + 1, number.size()));
    if (digits.starts_with('+')) digits.remove_prefix(1);
    int own_exponent = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), own_exponent);
    const std::string text = fmt::format("{}e{}", number.substr(0, end), own_exponent + exponent);
    double moved = 0;
    const bool is_read = std::from_chars(text.data(), text.data() + text.size(), moved).ec == std::errc{};
    return is_read ? moved : value * std::pow(10, exponent);  // underflow
}

double parse(std::string_view text, std::string_view what, std::span<const Unit> units, std::string_view hint) {
    double value = 0;
    const char* end = text.data() + text.size();
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [rest, status] = std::from_chars(begin, end, value);
    if (status != std::errc{} || !std::isfinite(value))
        throw Error(ErrorCode::usage,
                    fmt::format("{}: '{}' is not a number with a unit; write e.g. {}", what, text, hint));
    std::string_view unit(rest, static_cast<std::size_t>(end - rest));
    while (unit.starts_with(' ')) unit.remove_prefix(1);
    for (const Unit& known : units)
        if (unit == known.name)
            return known.scale * shifted({begin, static_cast<std::size_t>(rest - begin)}, value, known.exponent);
    if (unit.empty())
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' has no unit; write e.g. {}", what, text, hint));
    throw Error(ErrorCode::usage, fmt::format("{}: unknown unit '{}' in '{}'; write e.g. {}", what, unit, text, hint));
}

}  // namespace

double parse_length(std::string_view text, std::string_view what) {
    return parse(text, what, length_units, "16mm, 1.5um, 633nm, 5cm or 0.3m");
}

double parse_angle(std::string_view text, std::string_view what) {
    return parse(text, what, angle_units, "40deg or 0.7rad");
}

std::string format_length(double metres) {
    const double size = std::abs(metres);
    if (size == 0) return "0 mm";
    if (size < 1e-6) return fmt::format("{:.6g} nm", metres * 1e9);
    if (size < 1e-4) return fmt::format("{:.6g} um", metres * 1e6);
    if (size < 1) return fmt::format("{:.6g} mm", metres * 1e3);
    return fmt::format("{:.6g} m", metres);
}

std::string format_bytes(double bytes) {
    constexpr std::array<std::string_view, 6> names{"bytes", "kB", "MB", "GB", "TB", "PB"};
    std::size_t i = 0;
    while (bytes >= 999.5 && i + 1 < names.size()) {
        bytes /= 1000;
        ++i;
    }
    if (i == 0) return fmt::format("{:.0f} {}", bytes, names[i]);
    return bytes < 9.95 ? fmt::format("{:.1f} {}", bytes, names[i]) : fmt::format("{:.0f} {}", bytes, names[i]);
}

std::string format_duration(double seconds) {
    struct Unit {
        const char* name;
        double seconds;
    };
    // Each unit is used from two units upwards: keeps two digits, and never prints the number 1.
    constexpr std::array<Unit, 5> units{
        {{"years", 365.25 * 86400}, {"days", 86400}, {"hours", 3600}, {"minutes", 60}, {"s", 1}}};
    const auto* unit = std::ranges::find_if(units, [&](const Unit& each) { return seconds >= 1.995 * each.seconds; });
    if (unit == units.end()) --unit;
    const double value = seconds / unit->seconds;
    return value < 9.95 ? fmt::format("{:.1f} {}", value, unit->name) : fmt::format("{:.0f} {}", value, unit->name);
}

}  // namespace hogel
