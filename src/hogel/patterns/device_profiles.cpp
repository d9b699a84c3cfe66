// SPDX-License-Identifier: Apache-2.0
// Profiles of modulators in JSON (docs/modulators.md).
#include "hogel/patterns/device_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hogel/core/profiles.h"
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::patterns {
namespace fs = std::filesystem;
namespace {

using core::Profile;

// Returns a length in metres, the same as for the option with this number and unit.
double length(double number, const char* unit) {
    return number == 0 ? 0 : parse_length(fmt::format("{}{}", number, unit), unit);
}

void take_geometry(const Profile& profile, Modulator& modulator) {
    std::tie(modulator.width, modulator.height) = profile.sides("pixels", max_modulator_side);
    if (!profile.has("pixel_pitch_um")) profile.fail("pixel_pitch_um", "a number of micrometres");
    modulator.pitch = length(profile.number("pixel_pitch_um", 1e6, "a number of micrometres"), "um");
    modulator.fill_factor = profile.number("fill_factor", 1, "a number above 0, at most 1");
}

void take_levels(const Profile& profile, Modulator& modulator) {
    if (profile.has("levels") == profile.has("bits")) profile.fail("levels, bits", "one of them");
    const std::string levels = fmt::format("a whole number from 2 to {}", max_modulator_levels);
    const unsigned max_bits = static_cast<unsigned>(std::log2(max_modulator_levels));
    const std::size_t count =
        profile.has("bits")
            ? std::size_t{1} << profile.whole("bits", max_bits, fmt::format("a whole number from 1 to {}", max_bits))
            : profile.whole("levels", max_modulator_levels, levels);
    if (count < 2) profile.fail("levels", levels);
    modulator.levels = static_cast<unsigned>(count);
}

void take_light(const Profile& profile, Modulator& modulator) {
    modulator.modulation = profile.text("modulation");
    if (modulator.modulation != "phase" && modulator.modulation != "amplitude")
        profile.fail("modulation", "phase or amplitude");
    const std::string range = "two numbers of nanometres, the shortest wavelength first";
    const auto [shortest, longest] = profile.pair("wavelengths_nm", 1e9, range);
    if (shortest > longest) profile.fail("wavelengths_nm", range);
    modulator.shortest_wavelength = length(shortest, "nm");
    modulator.longest_wavelength = length(longest, "nm");
    modulator.refresh_rate = profile.number("refresh_hz", 1e9, "a number of hertz above 0");
    modulator.phase_code = profile.text("phase_code");
    try {
        if (!modulator.phase_code.empty()) parse_phase_code(modulator.phase_code);
    } catch (const Error& error) {
        profile.fail("phase_code", fmt::format("a phase code ({})", error.what()));
    }
}

// Files are relative to the folder of the profile.
void take_panel(const Profile& profile, const fs::path& folder, Modulator& modulator) {
    modulator.flip = profile.text("flip");
    if (!std::ranges::count(std::initializer_list<const char*>{"", "none", "horizontal", "vertical", "both"},
                            modulator.flip))
        profile.fail("flip", "none, horizontal, vertical or both");
    for (const auto& [member, file] :
         {std::pair{"lut", &modulator.lut}, std::pair{"correction", &modulator.correction}})
        if (const std::string name = profile.text(member, "a file name"); !name.empty())
            *file = (folder / name).string();
}

Modulator read_modulator(const core::ProfileFile& file) {
    const Profile profile(file);
    profile.require_kind("modulator");
    profile.require_known({"kind", "name", "aliases", "pixels", "pixel_pitch_um", "levels", "bits", "modulation",
                           "fill_factor", "wavelengths_nm", "refresh_hz", "phase_code", "flip", "lut", "correction",
                           "source", "verified", "note"});
    Modulator modulator{.name = file.name};
    modulator.title = profile.text("name");
    modulator.aliases = profile.texts("aliases");
    take_geometry(profile, modulator);
    take_levels(profile, modulator);
    take_light(profile, modulator);
    take_panel(profile, fs::path(file.file).parent_path(), modulator);
    modulator.source = profile.text("source");
    modulator.verified = profile.flag("verified");
    profile.require_source();
    modulator.note = profile.text("note");
    return modulator;
}

// Returns the modulators of profiles, without those of other kinds. One with an error has a fault.
std::vector<Modulator> modulators_of(const std::vector<core::ProfileFile>& files) {
    std::vector<Modulator> modulators;
    for (const core::ProfileFile& file : files) {
        if (core::kind_of(file) == "quilt") continue;
        try {
            modulators.push_back(read_modulator(file));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            modulators.push_back({.name = file.name, .fault = error.what()});
        }
    }
    return modulators;
}

}  // namespace

Modulator read_profile(const std::string& name, std::string_view text, const std::string& file) {
    return read_modulator({name, file, std::string(text)});
}

std::vector<Modulator> own_profiles() { return modulators_of(core::own_profile_files()); }

std::vector<Modulator> profiles_in(const fs::path& folder) { return modulators_of(core::profile_files_in(folder)); }

std::vector<Modulator> all_profiles() { return modulators_of(core::profile_files()); }

void require_modulator(const std::string& name, const std::vector<std::string>& known) {
    core::require_kind(name, "modulator", known);
}

}  // namespace hogel::patterns
