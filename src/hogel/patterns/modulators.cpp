// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <strings.h>

#include <algorithm>

#include "hogel/error.h"
#include "hogel/pattern.h"
#include "hogel/patterns/device_profiles.h"
#include "hogel/units.h"

namespace hogel {

Table<Modulator>& modulators() {
    static Table<Modulator> table("modulator", patterns::all_profiles(), "device");
    return table;
}

Modulator find_modulator(const std::string& name) {
    const std::vector<Modulator> rows = modulators().rows();
    if (rows.empty())
        throw Error(ErrorCode::not_built_in, "device",
                    "builds with HOGEL_MINIMAL=ON have no device profiles; describe the modulator by its pixels");
    const auto is_asked = [&](const std::string& word) { return strcasecmp(word.c_str(), name.c_str()) == 0; };
    auto found = std::ranges::find_if(rows, is_asked, &Modulator::name);
    if (found == rows.end())
        found = std::ranges::find_if(rows,
                                     [&](const Modulator& row) { return std::ranges::any_of(row.aliases, is_asked); });
    if (found == rows.end()) patterns::require_modulator(name, modulator_names());
    if (found == rows.end()) throw_unknown("modulator", name, modulator_names(), "device");
    if (!found->fault.empty()) throw Error(ErrorCode::bad_input, "device", found->fault);
    return *found;
}

std::vector<std::string> modulator_names() {
    std::vector<std::string> names;
    for (const Modulator& row : modulators().rows()) {
        names.push_back(row.name);
        names.insert(names.end(), row.aliases.begin(), row.aliases.end());
    }
    return names;
}

std::vector<std::string> notes_about(const Modulator& modulator, std::span<const double> wavelengths) {
    std::vector<std::string> notes;
    if (!modulator.verified)
        notes.push_back(fmt::format("profile {} is not verified: check its pixel pitch against the data sheet{}",
                                    modulator.name, modulator.source.empty() ? "" : " (" + modulator.source + ")"));
    if (!modulator.note.empty()) notes.push_back(fmt::format("profile {}: {}", modulator.name, modulator.note));
    for (const double wavelength : wavelengths)
        if (modulator.longest_wavelength > 0 &&
            (wavelength < modulator.shortest_wavelength || wavelength > modulator.longest_wavelength))
            notes.push_back(fmt::format("{} is made for {} to {}, not {}", modulator.name,
                                        format_length(modulator.shortest_wavelength),
                                        format_length(modulator.longest_wavelength), format_length(wavelength)));
    return notes;
}

}  // namespace hogel
