// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "hogel/core/device_names.h"
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
    const Modulator* const found = core::find_device(rows, name);
    if (found == nullptr) {
        patterns::require_modulator(name, modulator_names());
        throw_unknown("modulator", name, modulator_names(), "device");
    }
    if (!found->fault.empty()) throw Error(ErrorCode::bad_input, "device", found->fault);
    return *found;
}

std::vector<std::string> modulator_names() { return core::device_names(modulators().rows()); }

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
