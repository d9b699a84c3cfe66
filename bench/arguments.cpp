// SPDX-License-Identifier: Apache-2.0
#include "bench/arguments.h"

#include <fmt/format.h>

#include <numbers>

#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::bench {
namespace {

constexpr std::size_t max_count = std::size_t{1} << 24;  // larger counts along one side are rejected as typing errors
constexpr double degrees = 180 / std::numbers::pi;

}  // namespace

std::size_t parse_count(const std::string& text, const std::string& option) {
    const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    if (digits && text.size() < 10) {
        const std::size_t count = std::stoul(text);
        if (count > 0 && count <= max_count) return count;
    }
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a positive whole number", option, text));
}

Counts parse_counts(const std::string& text, const std::string& option) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) {
        const std::size_t side = parse_count(text, option);
        return {side, side};
    }
    return {parse_count(text.substr(0, cross), option), parse_count(text.substr(cross + 1), option)};
}

Angles parse_angles(const std::string& text, const std::string& option) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
        const double both = parse_angle(text, option);
        return {both, both};
    }
    std::string across = text.substr(0, comma);
    const std::string down = text.substr(comma + 1);
    constexpr const char* number = "+-.0123456789";
    // An angle without a unit has the unit of the last one.
    if (const std::size_t unit = down.find_first_not_of(number);
        unit != std::string::npos && across.find_first_not_of(number) == std::string::npos)
        across += down.substr(unit);
    return {parse_angle(across, option), parse_angle(down, option)};
}

std::string typed(const Counts& counts) { return fmt::format("{}x{}", counts.columns, counts.rows); }

std::string typed(const Angles& angles) {
    if (angles.across == angles.down) return fmt::format("{:.6g}deg", angles.across * degrees);
    return fmt::format("{:.6g},{:.6g}deg", angles.across * degrees, angles.down * degrees);
}

std::string typed_length(double metres) {
    std::string text = format_length(metres);
    std::erase(text, ' ');
    return text;
}

}  // namespace hogel::bench
