// SPDX-License-Identifier: Apache-2.0
#include "hogel/provenance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "hogel/error.h"

namespace hogel {
namespace {

constexpr const char* camera_key = "camera";
constexpr const char* background_key = "background";

auto find_key(auto& metadata, const std::string& key) {
    return std::ranges::find(metadata, key, [](const auto& entry) { return entry.first; });
}

// Returns whether an entry describes the command that made the file or an earlier one: name, options, program version.
bool is_of_command(std::string_view key) {
    while (key.starts_with("source ")) key.remove_prefix(7);
    return key == "software" || key == "command" || key.starts_with("option ");
}

}  // namespace

Metadata with_history(Metadata now, const Metadata& before) {
    const bool two_commands = find_key(now, "command") != now.end() && find_key(before, "command") != before.end();
    std::map<std::string, std::string> known(now.begin(), now.end());  // first text of each key
    for (const auto& [key, text] : before) {
        std::string free_key = two_commands && is_of_command(key) && key != "software" ? "source " + key : key;
        auto same = known.find(free_key);
        while (same != known.end() && same->second != text) same = known.find(free_key.insert(0, "source "));
        if (same != known.end()) continue;
        known.emplace(free_key, text);
        now.emplace_back(std::move(free_key), text);
    }
    return now;
}

Metadata to_metadata(const Provenance& provenance) {
    if (!provenance.camera) return provenance.entries;
    return with_history({{camera_key, describe(*provenance.camera)}}, provenance.entries);
}

Provenance to_provenance(Metadata metadata) {
    Provenance provenance;
    if (const auto found = find_key(metadata, camera_key); found != metadata.end()) {
        provenance.camera = parse_camera(found->second);
        if (provenance.camera) metadata.erase(found);
    }
    provenance.entries = std::move(metadata);
    return provenance;
}

std::pair<std::string, std::string> background_entry(Rgb background) {
    return {background_key, fmt::format("{} {} {}", background.r, background.g, background.b)};
}

Rgb background_of(const Provenance& provenance) {
    const auto found = find_key(provenance.entries, background_key);
    Rgb background{0, 0, 0};
    if (found == provenance.entries.end()) return background;
    std::istringstream text(found->second);
    Rgb read;
    const bool is_valid = text >> read.r >> read.g >> read.b && (text >> std::ws).eof();
    return is_valid && std::isfinite(read.r + read.g + read.b) ? read : background;
}

std::string describe(const Camera& camera) {
    const Grid& g = camera.picture;
    return fmt::format("eye {} {} {} focus {} {} {} pupil {} picture {} {} {} {} {} {}", camera.eye.x, camera.eye.y,
                       camera.eye.z, camera.focus_depth, camera.focus_slope_x, camera.focus_slope_y, camera.pupil,
                       g.width, g.height, g.pitch_x, g.pitch_y, g.center_x, g.center_y);
}

std::optional<Camera> parse_camera(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    const auto word = [&](const char* expected) {
        std::string found;
        if (in >> found && found != expected) in.setstate(std::ios::failbit);
    };
    Camera camera;
    Grid& g = camera.picture;
    word("eye");
    in >> camera.eye.x >> camera.eye.y >> camera.eye.z;
    word("focus");
    in >> camera.focus_depth >> camera.focus_slope_x >> camera.focus_slope_y;
    word("pupil");
    in >> camera.pupil;
    word("picture");
    in >> g.width >> g.height >> g.pitch_x >> g.pitch_y >> g.center_x >> g.center_y;
    std::string rest;
    if (!in || in >> rest) return {};
    try {
        validate(camera);
    } catch (const Error&) {
        return {};
    }
    return camera;
}

}  // namespace hogel
