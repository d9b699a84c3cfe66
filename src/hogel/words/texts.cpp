// SPDX-License-Identifier: Apache-2.0
#include "hogel/words/texts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/table.h"
#include "hogel/units.h"

namespace hogel::words {

using namespace literals;
namespace {

constexpr std::size_t max_count = std::size_t{1} << 24;  // larger counts are treated as typing errors

// Lengths outside this range (metres) are treated as typing errors; their squares could overflow.
constexpr double min_length = 1_nm * 1e-3, max_length = 1e6;

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

// Returns the unit of a list such as "1,2,3mm", given its last item: the text after the number.
std::string unit_of(const std::string& last) {
    double number = 0;
    const char* const end = last.data() + last.size();
    const char* const begin = last.data() + (last.starts_with('+') ? 1 : 0);
    return {std::from_chars(begin, end, number).ptr, end};
}

// Returns an item of a list with its unit, or with the unit of the last item if it has none.
std::string with_unit(const std::string& part, const std::string& unit) {
    return parse_number(part) ? part + unit : part;
}

// Parses up to three lengths: "638nm,520nm,450nm".
std::vector<double> parse_lengths(const std::string& text, const std::string& what) {
    const std::string unit = unit_of(text.substr(text.rfind(',') + 1));
    std::vector<double> lengths;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        lengths.push_back(parse_positive_length(with_unit(text.substr(begin, end - begin), unit), what));
        begin = end + 1;
    }
    if (lengths.size() > 3)
        throw Error(ErrorCode::usage, fmt::format("{}: {} given; expected at most three", what, lengths.size()));
    return lengths;
}

// Returns value * 10^-exponent as the shortest decimal number without an exponent that is parsed to the same value.
std::string shifted_text(double value, int exponent) {
    std::string digits = fmt::format("{:e}", std::abs(value));
    for (int precision = 0; precision < 17; ++precision) {
        digits = fmt::format("{:.{}e}", std::abs(value), precision);
        if (parse_number(digits) == std::abs(value)) break;
    }
    const std::size_t e = digits.find('e');
    const int before = std::stoi(digits.substr(e + 1)) - exponent + 1;  // digits before the decimal point
    digits.resize(e);
    std::erase(digits, '.');
    while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
    if (before <= 0) digits.insert(0, static_cast<std::size_t>(1 - before), '0');
    const auto point = static_cast<std::size_t>(std::max(before, 1));
    if (digits.size() < point) digits.append(point - digits.size(), '0');
    if (digits.size() > point) digits.insert(point, 1, '.');
    return (value < 0 ? "-" : "") + digits;
}

// Joins numbers with units; omits units equal to that of the last number.
std::string list_text(std::vector<std::string> texts) {
    const std::string unit = unit_of(texts.back());
    const auto is_plain = [&](const std::string& text) { return unit_of(text) == unit; };
    for (std::string& text : std::span(texts).first(texts.size() - 1))
        if (is_plain(text)) text.resize(text.size() - unit.size());
    return fmt::format("{}", fmt::join(texts, ","));
}

}  // namespace

double parse_positive_length(const std::string& text, const std::string& what) {
    const double metres = parse_any_length(text, what);
    if (metres >= min_length) return metres;
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a positive length", what, text));
}

double parse_finite_number(const std::string& text, const std::string& what) {
    if (const std::optional<double> number = parse_number(text)) return *number;
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not a number", what, text));
}

std::size_t parse_count(const std::string& text, const std::string& what) { return parse_count(text, what, ""); }

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

Counts parse_resolution(const std::string& text, const std::string& what) {
    Counts counts = parse_counts(text, what);
    if (text.find('x') == std::string::npos) counts.rows = 0;
    return counts;
}

Angles parse_angles(const std::string& text, const std::string& what) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
        const double both = parse_angle(text, what);
        return {both, both};
    }
    const std::string down = text.substr(comma + 1);
    if (down.find(',') != std::string::npos)
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' is neither one angle nor two", what, text));
    return {parse_angle(with_unit(text.substr(0, comma), unit_of(down)), what), parse_angle(down, what)};
}

Vec3 parse_rotation(const std::string& text, const std::string& what) {
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    const std::string z = text.substr(second + 1), unit = unit_of(z);
    if (first == std::string::npos || second == std::string::npos || z.find(',') != std::string::npos || unit.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("{}: '{}' is not a rotation; write the angles about x, y and z, such as -90,0,0deg",
                                what, text));
    const auto component = [&](const std::string& part) { return parse_angle(with_unit(part, unit), what); };
    return {component(text.substr(0, first)), component(text.substr(first + 1, second - first - 1)), component(z)};
}

std::vector<double> parse_wavelengths(const std::string& text, const std::string& what) {
    if (text == "rgb") return {defaults.red, defaults.green, defaults.blue};
    return parse_lengths(text, what);
}

bool parse_flag(const std::string& text, const std::string& what) {
    if (text == "yes") return true;
    if (text == "no") return false;
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is neither yes nor no", what, text));
}

std::string parse_choice(const std::string& text, const std::string& what, std::span<const std::string> choices) {
    if (std::ranges::count(choices, text)) return text;
    const std::string nearest = nearest_word(text, choices);
    throw Error(ErrorCode::usage, fmt::format("{}: '{}' is none of {}{}", what, text, fmt::join(choices, ", "),
                                              nearest.empty() ? "" : fmt::format(" (did you mean {}?)", nearest)));
}

std::string number_text(double number) { return fmt::format("{}", number); }

std::string counts_text(const Counts& counts) { return fmt::format("{}x{}", counts.columns, counts.rows); }

std::string resolution_text(const Counts& counts) {
    return counts.rows == 0 ? fmt::format("{}", counts.columns) : counts_text(counts);
}

std::string shell_word(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789._-+=,:/@%") == std::string::npos;
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace hogel::words

namespace hogel {

std::optional<double> parse_number(const std::string& text) {
    double number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), last, number);
    if (text.empty() || error != std::errc() || end != last || !std::isfinite(number)) return {};
    return number;
}

double parse_any_length(const std::string& text, const std::string& what) {
    const double metres = parse_length(text, what);
    if (std::abs(metres) <= words::max_length) return metres;
    throw Error(ErrorCode::usage,
                fmt::format("{}: '{}' is longer than {}", what, text, format_length(words::max_length)));
}

Vec3 parse_point(const std::string& text, const std::string& what) {
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    if (first == std::string::npos || second == std::string::npos || text.find(',', second + 1) != std::string::npos)
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not x,y,z; write e.g. 0,0,300mm", what, text));
    const std::string z = text.substr(second + 1), unit = words::unit_of(z);
    const auto component = [&](const std::string& part) {
        return parse_any_length(words::with_unit(part, unit), what);
    };
    return {component(text.substr(0, first)), component(text.substr(first + 1, second - first - 1)), component(z)};
}

std::string length_text(double metres) {
    const double size = std::abs(metres);
    if (size == 0) return "0mm";
    if (size < 1e-6) return words::shifted_text(metres, -9) + "nm";
    if (size < 1e-4) return words::shifted_text(metres, -6) + "um";
    if (size < 1) return words::shifted_text(metres, -3) + "mm";
    return words::shifted_text(metres, 0) + "m";
}

std::string lengths_text(const std::vector<double>& metres) {
    std::vector<std::string> texts;
    for (const double length : metres) texts.push_back(length_text(length));
    return fmt::format("{}", fmt::join(texts, ","));
}

std::string angle_text(double radians) {
    const double degrees = radians * 180 / std::numbers::pi;
    for (int digits = 1; digits <= 17 && std::isfinite(degrees); ++digits) {
        std::string text = fmt::format("{:.{}g}deg", degrees, digits);
        if (text.find('e') == text.find("deg") + 1 && parse_angle(text, "angle") == radians) return text;
    }
    return words::shifted_text(radians, 0) + "rad";
}

std::string angles_text(const Angles& angles) {
    if (angles.across == angles.down) return angle_text(angles.across);
    return words::list_text({angle_text(angles.across), angle_text(angles.down)});
}

std::string rotation_text(const Vec3& radians) {
    return words::list_text({angle_text(radians.x), angle_text(radians.y), angle_text(radians.z)});
}

std::string point_text(const Vec3& metres) {
    // A component of 0 takes the unit of the last.
    const auto text = [](double length) { return length == 0 ? std::string("0") : length_text(length); };
    return words::list_text({text(metres.x), text(metres.y), length_text(metres.z)});
}

}  // namespace hogel
