// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace hogel::core {

/// A file of a device profile in JSON (docs/modulators.md).
struct ProfileFile {
    std::string name;        ///< of the device: the file's, without its extension
    std::string file;        ///< for messages
    std::string text;        ///< JSON
    std::string fault = {};  ///< why the file cannot be read, or empty
};

/// Returns hogel's own profiles, or *.json of a folder, by name. A missing folder has none.
std::vector<ProfileFile> own_profile_files();
std::vector<ProfileFile> profile_files_in(const std::filesystem::path& folder);

/// Returns hogel's own profiles and those of the user's folder, which replace others of the same name.
std::vector<ProfileFile> profile_files();

/// Members of a profile. All functions throw Error(bad_input) with the file, the member and what was expected.
class Profile {
  public:
    explicit Profile(const ProfileFile& file);

    [[noreturn]] void fail(const std::string& member, const std::string& expected) const;
    /// Throws unless the profile is of this kind.
    void require_kind(const std::string& kind) const;
    /// Throws for a member that is none of these.
    void require_known(std::initializer_list<const char*> known) const;
    /// Throws if the profile is verified, but names no source.
    void require_source() const;

    /// Return a member, or an empty text or list.
    bool has(const std::string& member) const { return json_.contains(member); }
    std::string text(const std::string& member, const std::string& expected = "a text") const;
    std::vector<std::string> texts(const std::string& member) const;
    /// Returns a required member.
    bool flag(const std::string& member) const;

    /// Return a number or two numbers above 0 and at most `max`; 0 without the member.
    double number(const std::string& member, double max, const std::string& expected) const;
    std::pair<double, double> pair(const std::string& member, double max, const std::string& expected) const;
    /// Return a required whole number, or two of them.
    std::size_t whole(const std::string& member, double max, const std::string& expected) const;
    std::pair<std::size_t, std::size_t> sides(const std::string& member, double max) const;

  private:
    [[noreturn]] void reject(const std::string& fault) const;
    double positive(const nlohmann::json& value, double max, const std::string& member,
                    const std::string& expected) const;

    std::string file_;
    nlohmann::json json_;
};

/// Returns the kind of a profile, "modulator" or "quilt", or an empty text if its JSON has none.
std::string kind_of(const ProfileFile& file);

/// Throws Error(usage) if the profile of this name or alias, in upper or lower case, is of another kind.
/// @param known  names of the devices of this kind
void require_kind(const std::string& name, const std::string& kind, const std::vector<std::string>& known);

}  // namespace hogel::core
