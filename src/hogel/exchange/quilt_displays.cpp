// SPDX-License-Identifier: Apache-2.0
// Profiles of displays for quilts in JSON (docs/modulators.md).
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <tuple>
#include <utility>

#include "hogel/core/device_names.h"
#include "hogel/core/profiles.h"
#include "hogel/error.h"
#include "hogel/exchange.h"

namespace hogel {
namespace {

constexpr double max_quilt_side = 65536, max_tiles = 4096;

QuiltDisplay read_display(const core::ProfileFile& file) {
    const core::Profile profile(file);
    profile.require_kind("quilt");
    profile.require_known(
        {"kind", "name", "aliases", "pixels", "tiles", "aspect", "cone_deg", "source", "verified", "note"});
    QuiltDisplay display{.name = file.name};
    std::tie(display.width, display.height) = profile.sides("pixels", max_quilt_side);
    std::tie(display.columns, display.rows) = profile.sides("tiles", max_tiles);
    if (display.columns > display.width || display.rows > display.height)
        profile.fail("tiles", "at most one a pixel, across and down");
    const auto required = [&](const std::string& member, double max, const std::string& expected) {
        if (!profile.has(member)) profile.fail(member, expected);
        return profile.number(member, max, expected);
    };
    display.aspect = required("aspect", 100, "width/height of the display, above 0, at most 100");
    display.cone = required("cone_deg", 179, "an angle in degrees, above 0, at most 179") * std::numbers::pi / 180;
    display.title = profile.text("name");
    display.aliases = profile.texts("aliases");
    display.source = profile.text("source");
    display.verified = profile.flag("verified");
    profile.require_source();
    display.note = profile.text("note");
    return display;
}

std::vector<QuiltDisplay> all_displays() {
    std::vector<QuiltDisplay> displays;
    for (const core::ProfileFile& file : core::profile_files()) {
        if (core::kind_of(file) != "quilt") continue;
        try {
            displays.push_back(read_display(file));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            displays.push_back({.name = file.name, .fault = error.what()});
        }
    }
    std::ranges::stable_sort(displays, {}, [](const QuiltDisplay& each) {
        return std::pair(!each.fault.empty(), each.width * each.height);
    });
    return displays;
}

}  // namespace

Table<QuiltDisplay>& quilt_displays() {
    static Table<QuiltDisplay> table("display for quilts", all_displays(), "device");
    return table;
}

std::vector<std::string> quilt_display_names() { return core::device_names(quilt_displays().rows()); }

QuiltDisplay find_quilt_display(const std::string& name) {
    const std::vector<QuiltDisplay> rows = quilt_displays().rows();
    const QuiltDisplay* const found = core::find_device(rows, name);
    if (found == nullptr) {
        core::require_kind(name, "quilt", quilt_display_names());
        throw_unknown("display for quilts", name, quilt_display_names(), "device");
    }
    if (!found->fault.empty()) throw Error(ErrorCode::bad_input, "device", found->fault);
    return *found;
}

std::vector<std::string> notes_about(const QuiltDisplay& display) {
    std::vector<std::string> notes;
    if (!display.verified)
        notes.push_back(fmt::format("profile {} is not verified: check its tiles and cone against the data sheet{}",
                                    display.name, display.source.empty() ? "" : " (" + display.source + ")"));
    if (!display.note.empty()) notes.push_back(fmt::format("profile {}: {}", display.name, display.note));
    return notes;
}

}  // namespace hogel
