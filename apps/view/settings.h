// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "hogel/requests.h"

namespace hogel::view {

/// Parameters of the light field or hologram on the page. A page changes some of them ("hogels", "rotate"), with values
/// written as on the command line. Therefore the command lines on the page reproduce what it shows.
class Settings {
  public:
    using Words = std::map<std::string, std::string>;
    /// Returns whether a command ("photo") has an option ("size").
    using Takes = std::function<bool(const std::string& command, std::string_view option)>;

    /// Takes the given parameters of `hogel view` from a table of ViewerParameters.
    Settings(const Parameters& given, Takes takes);

    /// Returns settings with changed parameters; an empty value restores the initial one. Throws Error(usage) for a
    /// parameter that may not be changed and for a bad value.
    Settings with(const Words& changes) const;
    /// Returns the initial settings with another input. @param name  of the input in command lines
    Settings for_input(const std::string& file, const std::string& name) const;

    const ViewerParameters& options() const;
    /// Returns the table of the parameters; given ones have a value.
    const Parameters& table() const;
    std::uint64_t seed() const;
    /// Returns the file or scene to open; for a folder written by `hogel make`, its light field.
    const std::string& input() const { return input_; }
    /// Returns the name of the input on the page.
    const std::string& name() const { return name_; }
    /// Returns true if the settings differ only in parameters of holograms.
    bool same_light_field(const Settings& other) const;

    /// Returns the `hogel photo` command without the camera. For some layers of a stream, a `hogel decompress` command
    /// precedes it.
    std::string photo_command() const;
    /// Returns the same for the original of a compressed light field.
    std::string original_command() const;
    /// Returns the `hogel make` command of the scene, or `hogel hologram` if a given parameter requires it.
    std::string make_command() const;

  private:
    struct Values;

    void read();
    std::string command(const std::string& command, const std::string& input) const;

    Takes takes_;
    Words initial_, words_;  // texts of the given parameters except the input
    std::string input_, name_;
    bool is_dropped_ = false;  // the path of a dropped file differs from its name
    std::shared_ptr<const Values> values_;
};

}  // namespace hogel::view
