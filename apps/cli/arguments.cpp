// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <system_error>

#include "command_line.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"

namespace hogel::cli {

using namespace literals;
namespace {

constexpr std::size_t max_count = std::size_t{1} << 24;  // a larger number along one side is treated as a typing error

std::size_t parse_count(const std::string& text, const std::string& what, const char* hint) {
    const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    if (digits && text.size() < 10) {
        const std::size_t count = std::stoul(text);
        if (count > 0 && count <= max_count) return count;
    }
    if (digits && text.find_first_not_of('0') != std::string::npos)
        throw Error(ErrorCode::usage, fmt::format("{}: {} is too large; expected at most {}", what, text, max_count));
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a positive whole number{}", what, text, hint));
}

std::uint64_t parse_whole(const std::string& text, const std::string& what, std::uint64_t max) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size() || number > max)
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a whole number from 0 to {}", what, text, max));
    return number;
}

Counts parse_counts(const std::string& text, const std::string& what) {
    constexpr const char* hint = "; write e.g. 256x256";
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) {
        const std::size_t side = parse_count(text, what, hint);
        return {side, side};
    }
    return {parse_count(text.substr(0, cross), what, hint), parse_count(text.substr(cross + 1), what, hint)};
}

// The unit of a list such as "1,2,3mm": the text after its last number.
std::string unit_of(const std::string& last) {
    const std::size_t number = last.find_first_not_of("+-.0123456789");
    return number == std::string::npos ? "" : last.substr(number);
}

// A part of a list with its unit; if it has none, with that of the last part.
std::string with_unit(const std::string& part, const std::string& unit) {
    return part.find_first_not_of("+-.0123456789") == std::string::npos ? part + unit : part;
}

// Lengths beyond these are typing errors, and would overflow where they are squared.
constexpr double min_length = 1_nm * 1e-3, max_length = 1e6;

}  // namespace

double parse_any_length(const std::string& text, const std::string& what) {
    const double metres = parse_length(text, what);
    if (std::abs(metres) <= max_length) return metres;
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is longer than {}", what, text, format_length(max_length)));
}

namespace {

double parse_positive_length(const std::string& text, const std::string& what) {
    const double metres = parse_any_length(text, what);
    if (metres >= min_length) return metres;
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a positive length", what, text));
}

// "638nm,520nm,450nm": up to three.
std::vector<double> parse_lengths(const std::string& text, const std::string& what) {
    const std::string unit = unit_of(text.substr(text.rfind(',') + 1));
    std::vector<double> lengths;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        lengths.push_back(parse_positive_length(with_unit(text.substr(begin, end - begin), unit), what));
        begin = end + 1;
    }
    if (lengths.size() > 3)
        throw Error(ErrorCode::usage,
                    fmt::format("{}: {} were given; at most three were expected", what, lengths.size()));
    return lengths;
}

Angles parse_angles(const std::string& text, const std::string& what) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
        const double both = parse_angle(text, what);
        return {both, both};
    }
    const std::string down = text.substr(comma + 1);
    return {parse_angle(with_unit(text.substr(0, comma), unit_of(down)), what), parse_angle(down, what)};
}

}  // namespace

Vec3 parse_point(const std::string& text, const std::string& what) {
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    if (first == std::string::npos || second == std::string::npos || text.find(',', second + 1) != std::string::npos)
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not x,y,z; write e.g. 0,0,300mm", what, text));
    const std::string z = text.substr(second + 1), unit = unit_of(z);
    const auto component = [&](const std::string& part) { return parse_any_length(with_unit(part, unit), what); };
    return {component(text.substr(0, first)), component(text.substr(first + 1, second - first - 1)), component(z)};
}

namespace {

std::string degrees(double radians) { return fmt::format("{:.6g}", radians * 180 / std::numbers::pi); }

}  // namespace

Option Command::length(const std::string& name, double& metres, const std::string& help) {
    return read_option(
        name, "LENGTH", compact_length(metres), help,
        [&metres](const std::string& text, const std::string& what) { metres = parse_any_length(text, what); });
}

Option Command::positive_length(const std::string& name, double& metres, const std::string& help) {
    return read_option(
        name, "LENGTH", compact_length(metres), help,
        [&metres](const std::string& text, const std::string& what) { metres = parse_positive_length(text, what); });
}

Option Command::angle(const std::string& name, double& radians, const std::string& help) {
    return read_option(
        name, "ANGLE", degrees(radians) + "deg", help,
        [&radians](const std::string& text, const std::string& what) { radians = parse_angle(text, what); });
}

Option Command::angles(const std::string& name, Angles& angles, const std::string& help) {
    const std::string across = degrees(angles.across), down = degrees(angles.down);
    return read_option(
        name, "ANGLE[,ANGLE]", across == down ? across + "deg" : across + "," + down + "deg", help,
        [&angles](const std::string& text, const std::string& what) { angles = parse_angles(text, what); });
}

Option Command::counts(const std::string& name, Counts& counts, const std::string& help) {
    return read_option(
        name, "WxH", fmt::format("{}x{}", counts.columns, counts.rows), help,
        [&counts](const std::string& text, const std::string& what) { counts = parse_counts(text, what); });
}

Option Command::resolution(const std::string& name, Counts& counts, const std::string& help) {
    return read_option(name, "W|WxH", fmt::format("{}", counts.columns), help,
                       [&counts](const std::string& text, const std::string& what) {
                           counts = parse_counts(text, what);
                           if (text.find('x') == std::string::npos) counts.rows = 0;
                       });
}

Option Command::point(const std::string& name, Vec3& point, const std::string& help) {
    const std::string shown = fmt::format("{:.6g},{:.6g},{:.6g}mm", point.x * 1e3, point.y * 1e3, point.z * 1e3);
    return read_option(name, "X,Y,Z", shown, help,
                       [&point](const std::string& text, const std::string& what) { point = parse_point(text, what); });
}

Option Command::count(const std::string& name, std::size_t& count, const std::string& help) {
    return read_option(
        name, "N", fmt::format("{}", count), help,
        [&count](const std::string& text, const std::string& what) { count = parse_count(text, what, ""); });
}

Option Command::whole(const std::string& name, std::uint64_t& number, std::uint64_t max, const std::string& help) {
    return read_option(
        name, "N", fmt::format("{}", number), help,
        [&number, max](const std::string& text, const std::string& what) { number = parse_whole(text, what, max); });
}

Option Command::wavelengths(std::vector<double>& wavelengths) {
    wavelengths = {defaults.red, defaults.green, defaults.blue};
    return read_option("--wavelength", "LENGTH[,...]|rgb", "rgb",
                       fmt::format("Wavelengths, or rgb for {}, {} and {}", format_length(defaults.red),
                                   format_length(defaults.green), format_length(defaults.blue)),
                       [&wavelengths](const std::string& text, const std::string& what) {
                           if (text == "rgb")
                               wavelengths = {defaults.red, defaults.green, defaults.blue};
                           else
                               wavelengths = parse_lengths(text, what);
                       });
}

std::optional<double> parse_number(const std::string& text) {
    double number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), last, number);
    if (text.empty() || error != std::errc() || end != last || !std::isfinite(number)) return {};
    return number;
}

std::string compact_length(double metres) {
    std::string text = format_length(metres);
    std::erase(text, ' ');
    return text;
}

std::size_t colour_of(double wavelength) {
    if (wavelength >= 580_nm) return 0;
    return wavelength >= 490_nm ? 1 : 2;
}

}  // namespace hogel::cli
