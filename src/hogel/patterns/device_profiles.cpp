// SPDX-License-Identifier: Apache-2.0
// Profiles of modulators in JSON (docs/modulators.md).
#include "hogel/patterns/device_profiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>

#include "hogel/core/json.h"
#include "hogel/error.h"
#include "hogel/units.h"
#include "own_profiles.h"

namespace hogel::patterns {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t max_bytes = 1 << 20;

/// Members of a profile. Errors name the file, the member and what was expected.
class Members {
  public:
    Members(std::string_view text, std::string file) : file_(std::move(file)) {
        json_ = core::parse_json(text, [&](const std::string& fault) { reject(fault); });
        if (!json_.is_object()) reject("expected one object of JSON");
    }

    [[noreturn]] void fail(const std::string& member, const std::string& expected) const {
        reject(fmt::format("{}: expected {}", member, expected));
    }
    bool has(const std::string& member) const { return json_.contains(member); }
    std::string text(const std::string& member, const std::string& expected = "a text") const {
        if (!has(member)) return "";
        if (!json_[member].is_string()) fail(member, expected);
        return json_[member].get<std::string>();
    }
    std::vector<std::string> texts(const std::string& member) const {
        std::vector<std::string> values;
        for (const Json& value : has(member) ? json_[member] : Json::array()) {
            if (!json_[member].is_array() || !value.is_string()) fail(member, "a list of texts");
            values.push_back(value.get<std::string>());
        }
        return values;
    }
    bool flag(const std::string& member) const {
        if (!has(member) || !json_[member].is_boolean()) fail(member, "true or false");
        return json_[member].get<bool>();
    }
    /// Returns a number, or the pair of numbers, of which each is above 0 and at most `max`.
    double number(const std::string& member, double max, const std::string& expected) const {
        return has(member) ? positive(json_[member], max, member, expected) : 0;
    }
    std::pair<double, double> pair(const std::string& member, double max, const std::string& expected) const {
        if (!has(member)) return {0, 0};
        if (!json_[member].is_array() || json_[member].size() != 2) fail(member, expected);
        return {positive(json_[member][0], max, member, expected), positive(json_[member][1], max, member, expected)};
    }
    void require_known(std::initializer_list<const char*> known) const {
        for (const auto& [member, value] : json_.items())
            if (!std::ranges::count(known, member))
                reject(
                    fmt::format("{}: is no member of a profile; expected one of {}", member, fmt::join(known, ", ")));
    }

  private:
    [[noreturn]] void reject(const std::string& fault) const {
        throw Error(ErrorCode::bad_input, fmt::format("{}: {}", file_, fault));
    }
    double positive(const Json& value, double max, const std::string& member, const std::string& expected) const {
        const double number = value.is_number() ? value.get<double>() : 0;
        if (!(number > 0 && number <= max)) fail(member, expected);
        return number;
    }

    std::string file_;
    Json json_;
};

// Returns a length in metres, the same as for the option with this number and unit.
double length(double number, const char* unit) {
    return number == 0 ? 0 : parse_length(fmt::format("{}{}", number, unit), unit);
}

std::size_t whole(const Members& members, const std::string& member, double number, const std::string& expected) {
    if (number != std::floor(number)) members.fail(member, expected);
    return static_cast<std::size_t>(number);
}

void take_geometry(const Members& members, Modulator& modulator) {
    const std::string sides = fmt::format("two whole numbers up to {}, across and down", max_modulator_side);
    if (!members.has("pixels")) members.fail("pixels", sides);
    const auto [width, height] = members.pair("pixels", max_modulator_side, sides);
    modulator.width = whole(members, "pixels", width, sides);
    modulator.height = whole(members, "pixels", height, sides);
    if (!members.has("pixel_pitch_um")) members.fail("pixel_pitch_um", "a number of micrometres");
    modulator.pitch = length(members.number("pixel_pitch_um", 1e6, "a number of micrometres"), "um");
    modulator.fill_factor = members.number("fill_factor", 1, "a number above 0, at most 1");
}

void take_levels(const Members& members, Modulator& modulator) {
    if (members.has("levels") == members.has("bits")) members.fail("levels, bits", "one of them");
    const std::string levels = fmt::format("a whole number from 2 to {}", max_modulator_levels);
    const unsigned max_bits = static_cast<unsigned>(std::log2(max_modulator_levels));
    const std::string bits = fmt::format("a whole number from 1 to {}", max_bits);
    const std::size_t count =
        members.has("bits") ? std::size_t{1} << whole(members, "bits", members.number("bits", max_bits, bits), bits)
                            : whole(members, "levels", members.number("levels", max_modulator_levels, levels), levels);
    if (count < 2) members.fail("levels", levels);
    modulator.levels = static_cast<unsigned>(count);
}

void take_light(const Members& members, Modulator& modulator) {
    modulator.modulation = members.text("modulation");
    if (modulator.modulation != "phase" && modulator.modulation != "amplitude")
        members.fail("modulation", "phase or amplitude");
    const std::string range = "two numbers of nanometres, the shortest wavelength first";
    const auto [shortest, longest] = members.pair("wavelengths_nm", 1e9, range);
    if (shortest > longest) members.fail("wavelengths_nm", range);
    modulator.shortest_wavelength = length(shortest, "nm");
    modulator.longest_wavelength = length(longest, "nm");
    modulator.refresh_rate = members.number("refresh_hz", 1e9, "a number of hertz above 0");
    modulator.phase_code = members.text("phase_code");
    try {
        if (!modulator.phase_code.empty()) parse_phase_code(modulator.phase_code);
    } catch (const Error& error) {
        members.fail("phase_code", fmt::format("a phase code ({})", error.what()));
    }
}

// Files are relative to the folder of the profile.
void take_panel(const Members& members, const fs::path& folder, Modulator& modulator) {
    modulator.flip = members.text("flip");
    if (!std::ranges::count(std::initializer_list<const char*>{"", "none", "horizontal", "vertical", "both"},
                            modulator.flip))
        members.fail("flip", "none, horizontal, vertical or both");
    for (const auto& [member, file] :
         {std::pair{"lut", &modulator.lut}, std::pair{"correction", &modulator.correction}})
        if (const std::string name = members.text(member, "a file name"); !name.empty())
            *file = (folder / name).string();
}

// Returns the profile, or a modulator whose `fault` says why there is none.
Modulator profile_or_fault(const std::string& name, const std::function<std::string()>& text, const std::string& file) {
    try {
        return read_profile(name, text(), file);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input) throw;
        Modulator modulator{.name = name};
        modulator.fault = error.what();
        return modulator;
    }
}

std::string read_text(const fs::path& file) {
    std::error_code error;
    std::ifstream stream(file, std::ios::binary);
    if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > max_bytes || error || !stream)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is no readable file of at most {} bytes", file.string(), max_bytes));
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

Modulator read_profile(const std::string& name, std::string_view text, const std::string& file) {
    const Members members(text, file);
    if (const std::string kind = members.text("kind", "modulator"); kind != "modulator")
        members.fail("kind", kind.empty() ? "modulator" : fmt::format("modulator, not {}", kind));
    members.require_known({"kind", "name", "aliases", "pixels", "pixel_pitch_um", "levels", "bits", "modulation",
                           "fill_factor", "wavelengths_nm", "refresh_hz", "phase_code", "flip", "lut", "correction",
                           "source", "verified", "note"});
    Modulator modulator{.name = name};
    modulator.title = members.text("name");
    modulator.aliases = members.texts("aliases");
    take_geometry(members, modulator);
    take_levels(members, modulator);
    take_light(members, modulator);
    take_panel(members, fs::path(file).parent_path(), modulator);
    modulator.source = members.text("source");
    modulator.verified = members.flag("verified");
    if (modulator.verified && modulator.source.empty())
        members.fail("source", "the address of a data sheet, as verified is true");
    modulator.note = members.text("note");
    return modulator;
}

std::vector<Modulator> own_profiles() {
    std::vector<Modulator> profiles;
    for (const auto& [name, text] : own_profile_files) profiles.push_back(read_profile(name, text, name));
    return profiles;
}

std::vector<Modulator> profiles_in(const fs::path& folder) {
    std::vector<Modulator> profiles;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const fs::path& file = entry.path();
        if (file.extension() != ".json") continue;
        profiles.push_back(profile_or_fault(
            file.stem().string(), [&] { return read_text(file); }, file.string()));
    }
    std::ranges::sort(profiles, {}, &Modulator::name);
    return profiles;
}

fs::path user_profiles() {
    const auto variable = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
    const std::string config = variable("XDG_CONFIG_HOME"), home = variable("HOME");
    if (config.empty() && home.empty()) return {};
    return (config.empty() ? fs::path(home) / ".config" : fs::path(config)) / "hogel" / "devices";
}

}  // namespace hogel::patterns
