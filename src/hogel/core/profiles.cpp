// SPDX-License-Identifier: Apache-2.0
// Files of device profiles, and their members.
#include "hogel/core/profiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <strings.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "hogel/core/json.h"
#include "hogel/error.h"
#include "own_profiles.h"

namespace hogel::core {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t max_profile_bytes = 1 << 20;

std::string read_profile_text(const fs::path& file) {
    std::error_code error;
    std::ifstream stream(file, std::ios::binary);
    if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > max_profile_bytes || error || !stream)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: is no readable file of at most {} bytes", file.string(), max_profile_bytes));
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Returns the user's folder, or an empty path without a home.
fs::path user_folder() {
    const auto variable = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
    const std::string config = variable("XDG_CONFIG_HOME"), home = variable("HOME");
    if (config.empty() && home.empty()) return {};
    return (config.empty() ? fs::path(home) / ".config" : fs::path(config)) / "hogel" / "devices";
}

// Returns the name and the aliases of a device.
std::vector<std::string> names_of(const ProfileFile& file) {
    std::vector<std::string> names{file.name};
    try {
        for (std::string& alias : Profile(file).texts("aliases")) names.push_back(std::move(alias));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input) throw;
    }
    return names;
}

// Returns a noun for the devices of a kind.
std::string noun_of(const std::string& kind) {
    return kind == "modulator" ? "modulator" : kind == "quilt" ? "display for quilts" : kind;
}

}  // namespace

std::vector<ProfileFile> own_profile_files() {
    std::vector<ProfileFile> files;
    for (const auto& [name, text] : own_profile_texts) files.push_back({name, name, text});
    return files;
}

std::vector<ProfileFile> profile_files_in(const fs::path& folder) {
    std::vector<ProfileFile> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const fs::path& path = entry.path();
        if (path.extension() != ".json") continue;
        ProfileFile& file = files.emplace_back(ProfileFile{path.stem().string(), path.string(), ""});
        try {
            file.text = read_profile_text(path);
        } catch (const Error& fault) {
            file.fault = fault.what();
        }
    }
    std::ranges::sort(files, {}, &ProfileFile::name);
    return files;
}

std::vector<ProfileFile> profile_files() {
    std::vector<ProfileFile> files = own_profile_files();
    for (ProfileFile& users : profile_files_in(user_folder())) {
        const auto same = std::ranges::find(files, users.name, &ProfileFile::name);
        if (same == files.end())
            files.push_back(std::move(users));
        else
            *same = std::move(users);
    }
    return files;
}

Profile::Profile(const ProfileFile& file) : file_(file.file) {
    if (!file.fault.empty()) throw Error(ErrorCode::bad_input, file.fault);
    json_ = parse_json(file.text, [&](const std::string& fault) { reject(fault); });
    if (!json_.is_object()) reject("expected one object of JSON");
}

void Profile::reject(const std::string& fault) const {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}", file_, fault));
}

void Profile::fail(const std::string& member, const std::string& expected) const {
    reject(fmt::format("{}: expected {}", member, expected));
}

void Profile::require_kind(const std::string& kind) const {
    if (const std::string own = text("kind", kind); own != kind)
        fail("kind", own.empty() ? kind : fmt::format("{}, not {}", kind, own));
}

void Profile::require_known(std::initializer_list<const char*> known) const {
    for (const auto& [member, value] : json_.items())
        if (!std::ranges::count(known, member))
            reject(fmt::format("{}: is no member of a profile; expected one of {}", member, fmt::join(known, ", ")));
}

void Profile::require_source() const {
    if (flag("verified") && text("source").empty()) fail("source", "the address of a data sheet, as verified is true");
}

std::string Profile::text(const std::string& member, const std::string& expected) const {
    if (!has(member)) return "";
    if (!json_[member].is_string()) fail(member, expected);
    return json_[member].get<std::string>();
}

std::vector<std::string> Profile::texts(const std::string& member) const {
    std::vector<std::string> values;
    for (const Json& value : has(member) ? json_[member] : Json::array()) {
        if (!json_[member].is_array() || !value.is_string()) fail(member, "a list of texts");
        values.push_back(value.get<std::string>());
    }
    return values;
}

bool Profile::flag(const std::string& member) const {
    if (!has(member) || !json_[member].is_boolean()) fail(member, "true or false");
    return json_[member].get<bool>();
}

double Profile::positive(const Json& value, double max, const std::string& member, const std::string& expected) const {
    const double number = value.is_number() ? value.get<double>() : 0;
    if (!(number > 0 && number <= max)) fail(member, expected);
    return number;
}

double Profile::number(const std::string& member, double max, const std::string& expected) const {
    return has(member) ? positive(json_[member], max, member, expected) : 0;
}

std::pair<double, double> Profile::pair(const std::string& member, double max, const std::string& expected) const {
    if (!has(member)) return {0, 0};
    if (!json_[member].is_array() || json_[member].size() != 2) fail(member, expected);
    return {positive(json_[member][0], max, member, expected), positive(json_[member][1], max, member, expected)};
}

std::size_t Profile::whole(const std::string& member, double max, const std::string& expected) const {
    const double value = number(member, max, expected);
    if (value < 1 || value != std::floor(value)) fail(member, expected);
    return static_cast<std::size_t>(value);
}

std::pair<std::size_t, std::size_t> Profile::sides(const std::string& member, double max) const {
    const std::string expected = fmt::format("two whole numbers up to {}, across and down", max);
    const auto [across, down] = pair(member, max, expected);
    if (across < 1 || across != std::floor(across) || down < 1 || down != std::floor(down)) fail(member, expected);
    return {static_cast<std::size_t>(across), static_cast<std::size_t>(down)};
}

std::string kind_of(const ProfileFile& file) {
    try {
        return Profile(file).text("kind");
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input) throw;
        return "";
    }
}

void require_kind(const std::string& name, const std::string& kind, const std::vector<std::string>& known) {
    const auto is_asked = [&](const std::string& word) { return strcasecmp(word.c_str(), name.c_str()) == 0; };
    for (const ProfileFile& file : profile_files()) {
        const std::string other = kind_of(file);
        if (other.empty() || other == kind) continue;
        if (!std::ranges::any_of(names_of(file), is_asked)) continue;
        throw Error(ErrorCode::usage, "device",
                    fmt::format("'{}' is a {}, not a {}; expected one of {}", name, noun_of(other), noun_of(kind),
                                fmt::join(known, ", ")));
    }
}

}  // namespace hogel::core
