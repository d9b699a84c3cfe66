// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "hogel/pipeline.h"
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::cli {
namespace {

constexpr std::size_t max_count = std::size_t{1} << 24;  // more along one side is a slip of the finger

std::size_t parse_count(const std::string& text, const std::string& what, const char* hint) {
    const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    if (digits && text.size() < 10) {
        const std::size_t count = std::stoul(text);
        if (count > 0 && count <= max_count) return count;
    }
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a positive whole number{}", what, text, hint));
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

// The part of "1,2,3mm" after its last number.
std::string unit_of(const std::string& last) {
    const std::size_t number = last.find_first_not_of("+-.0123456789");
    return number == std::string::npos ? "" : last.substr(number);
}

// One of the parts: with a unit of its own, or else with the one of the last.
std::string with_unit(const std::string& part, const std::string& unit) {
    return part.find_first_not_of("+-.0123456789") == std::string::npos ? part + unit : part;
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

Vec3 parse_point(const std::string& text, const std::string& what) {
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    if (first == std::string::npos || second == std::string::npos || text.find(',', second + 1) != std::string::npos)
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not x,y,z; write e.g. 0,0,300mm", what, text));
    const std::string z = text.substr(second + 1), unit = unit_of(z);
    const auto component = [&](const std::string& part) { return parse_length(with_unit(part, unit), what); };
    return {component(text.substr(0, first)), component(text.substr(first + 1, second - first - 1)), component(z)};
}

// An option that is read by a function of its text and its name.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App* command, const std::string& name, Value& value, const std::string& help,
                        const char* type, const std::string& shown, Parse parse) {
    return command
        ->add_option_function<std::string>(
            name, [&value, name, parse](const std::string& text) { value = parse(text, name); }, help)
        ->type_name(type)
        ->default_str(shown);
}

// Without the space that format_length puts before the unit: as one types it.
std::string typed(double metres) {
    std::string text = format_length(metres);
    std::erase(text, ' ');
    return text;
}

}  // namespace

CLI::Option* add_length(CLI::App* command, const std::string& name, double& metres, const std::string& help) {
    return add_parsed(command, name, metres, help, "LENGTH", typed(metres),
                      [](const std::string& text, const std::string& what) { return parse_length(text, what); });
}

CLI::Option* add_angle(CLI::App* command, const std::string& name, double& radians, const std::string& help) {
    return add_parsed(command, name, radians, help, "ANGLE", fmt::format("{:.6g}deg", radians * 180 / std::numbers::pi),
                      [](const std::string& text, const std::string& what) { return parse_angle(text, what); });
}

CLI::Option* add_angles(CLI::App* command, const std::string& name, Angles& angles, const std::string& help) {
    const double across = angles.across * 180 / std::numbers::pi, down = angles.down * 180 / std::numbers::pi;
    const std::string shown =
        across == down ? fmt::format("{:.6g}deg", across) : fmt::format("{:.6g},{:.6g}deg", across, down);
    return add_parsed(command, name, angles, help, "ANGLE[,ANGLE]", shown, parse_angles);
}

CLI::Option* add_counts(CLI::App* command, const std::string& name, Counts& counts, const std::string& help) {
    return add_parsed(command, name, counts, help, "WxH", fmt::format("{}x{}", counts.columns, counts.rows),
                      parse_counts);
}

CLI::Option* add_resolution(CLI::App* command, const std::string& name, Counts& counts, const std::string& help) {
    return add_parsed(command, name, counts, help, "W|WxH", fmt::format("{}", counts.columns),
                      [](const std::string& text, const std::string& what) {
                          Counts read = parse_counts(text, what);
                          if (text.find('x') == std::string::npos) read.rows = 0;
                          return read;
                      });
}

CLI::Option* add_point(CLI::App* command, const std::string& name, Vec3& point, const std::string& help) {
    return add_parsed(command, name, point, help, "X,Y,Z",
                      fmt::format("{:.6g},{:.6g},{:.6g}mm", point.x * 1e3, point.y * 1e3, point.z * 1e3), parse_point);
}

CLI::Option* add_count(CLI::App* command, const std::string& name, std::size_t& count, const std::string& help) {
    return add_parsed(command, name, count, help, "N", fmt::format("{}", count),
                      [](const std::string& text, const std::string& what) { return parse_count(text, what, ""); });
}

CLI::Option* add_wavelengths(CLI::App* command, std::vector<double>& wavelengths) {
    wavelengths = {defaults.red, defaults.green, defaults.blue};
    return add_parsed(command, "--wavelength", wavelengths,
                      fmt::format("Wavelength, or rgb for {}, {} and {}", format_length(defaults.red),
                                  format_length(defaults.green), format_length(defaults.blue)),
                      "LENGTH|rgb", "rgb", [](const std::string& text, const std::string& what) {
                          if (text == "rgb") return std::vector{defaults.red, defaults.green, defaults.blue};
                          return std::vector{parse_length(text, what)};
                      });
}

std::size_t colour_of(double wavelength) {
    if (wavelength >= 580_nm) return 0;
    return wavelength >= 490_nm ? 1 : 2;
}

}  // namespace hogel::cli
