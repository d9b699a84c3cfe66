// SPDX-License-Identifier: Apache-2.0
#include "hogel/phase_code.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

#include "hogel/error.h"

namespace hogel {
namespace {

constexpr double pi = std::numbers::pi, full_turn = 2 * pi;

// Phase codes of other programs (docs/holograms-from-elsewhere.md names the functions).
std::vector<PhaseCodeInfo> known_codes() {
    return {
        {"hogel", "256 to a turn, 0 is black", {full_turn, 0, false, false}},
        {"neural-holography", "255 to a turn, -pi is white and pi black", {full_turn, -pi, true, true}},
        {"slmsuite", "256 to a turn, 0 is white and larger phases are darker", {full_turn, 0, true, false}},
        {"odak", "255 to a turn, 0 is black", {full_turn, 0, false, true}},
        {"tensorholo", "-pi is 0, pi is 1 (or white)", {full_turn, -pi, false, true}},
    };
}

[[noreturn]] void fail(const std::string& text, const std::string& why) {
    throw Error(ErrorCode::usage, "phase_code",
                fmt::format("the phase code '{}' {}; expected {}, or e.g. "
                            "range=2pi,offset=-180deg,invert",
                            text, why, fmt::join(phase_codes().names(), ", ")));
}

std::optional<double> parse_angle_of_code(std::string_view text) {
    double number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    std::string_view unit(end, static_cast<std::size_t>(last - end));
    const bool bare = end == text.data();
    if (bare && (text == "pi" || text == "-pi")) return text == "pi" ? pi : -pi;
    if (bare || error != std::errc() || !std::isfinite(number) || std::abs(number) > 1e6) return {};
    if (unit == "pi") return number * pi;
    if (unit == "deg") return number * pi / 180;
    if (unit == "rad" || (unit.empty() && number == 0)) return number;
    return {};
}

}  // namespace

double PhaseCode::phase(double number, double largest) const {
    const double count = largest == 0 ? 1 : closed ? largest : largest + 1;
    const double from_lowest = inverted ? (largest == 0 ? 1 : largest) - number : number;
    return offset + range * (from_lowest / count);
}

unsigned PhaseCode::level(double phase, unsigned largest) const {
    const double count = closed ? largest : largest + 1.0;
    double above = std::fmod(phase - offset, full_turn);
    if (above < 0) above += full_turn;
    double level = std::round(above / range * count);
    if (level > largest) {
        // Uses the nearer end of the range, modulo a full turn.
        const double highest = range * largest / count;
        level = above - highest <= full_turn - above ? largest : 0;
    }
    const auto code_level = static_cast<unsigned>(level);
    return inverted ? largest - code_level : code_level;
}

Table<PhaseCodeInfo>& phase_codes() {
    static Table<PhaseCodeInfo> table("phase code", known_codes(), "phase_code");
    return table;
}

PhaseCode parse_phase_code(const std::string& text) {
    if (const PhaseCodeInfo* known = phase_codes().look_up(text)) return known->code;
    if (text.find('=') == std::string::npos && text != "invert") return phase_codes().find(text).code;
    PhaseCode code{full_turn, 0, false, true};
    for (std::string_view remaining = text; !remaining.empty();) {
        const std::size_t comma = remaining.find(',');
        const std::string_view part = remaining.substr(0, comma);
        remaining = comma == std::string_view::npos ? std::string_view{} : remaining.substr(comma + 1);
        if (comma != std::string_view::npos && remaining.empty()) fail(text, "ends with a comma");
        const std::size_t equals = part.find('=');
        const std::string_view name = part.substr(0, equals);
        if (part == "invert") {
            code.inverted = true;
            continue;
        }
        if ((name != "range" && name != "offset") || equals == std::string_view::npos)
            fail(text, fmt::format("holds '{}'", part));
        const std::optional<double> angle = parse_angle_of_code(part.substr(equals + 1));
        if (!angle) fail(text, fmt::format("holds '{}', which is not an angle", part));
        (name == "range" ? code.range : code.offset) = *angle;
    }
    if (!(code.range > 0)) fail(text, "has no range above 0");
    return code;
}

std::string phase_code_text(const PhaseCode& code) {
    for (const PhaseCodeInfo& known : phase_codes().rows())
        if (known.code == code) return known.name;
    return fmt::format("range={}rad,offset={}rad{}", code.closed ? code.range : code.range * 255 / 256, code.offset,
                       code.inverted ? ",invert" : "");
}

}  // namespace hogel
