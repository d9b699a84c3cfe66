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

/// The parameters of what is looked at. A page changes some ("hogels", "rotate") by texts that hogel takes on its
/// command line, too. So what the page shows, what it copies and what hogel makes of that are the same.
class Settings {
  public:
    using Words = std::map<std::string, std::string>;
    /// Whether a command ("photo") has an option ("size").
    using Takes = std::function<bool(const std::string& command, std::string_view option)>;

    /// Those of `hogel view` that are given in a table of ViewerParameters, of a command line.
    Settings(const Parameters& given, Takes takes);

    /// With other values of some parameters, and without those whose value is empty. Throws Error(usage) for a
    /// parameter that may not be changed, and for a value that hogel would refuse.
    Settings with(const Words& changes) const;
    /// The first ones with another input, by its name in command lines.
    Settings of(const std::string& file, const std::string& name) const;

    const ViewerParameters& options() const;
    /// Their table, in which given ones have a value.
    const Parameters& table() const;
    std::uint64_t seed() const;
    /// The file or scene to open: of a folder that hogel make wrote its light field.
    const std::string& input() const { return input_; }
    /// As the page names it.
    const std::string& name() const { return name_; }
    /// Whether both make the same light field: they differ in parameters of holograms alone.
    bool same_light_field(const Settings& other) const;

    /// `hogel photo` of this, without the camera; of the first layers of a stream behind `hogel decompress`.
    std::string photo_command() const;
    /// The same of the light field beside which errors are shown.
    std::string original_command() const;
    /// `hogel make` of this scene; with parameters of holograms that it does not have, `hogel hologram`.
    std::string make_command() const;

  private:
    struct Line;

    void read();
    std::string command(const std::string& command, const std::string& input) const;

    Takes takes_;
    Words first_, words_;  // the texts of given parameters but the input
    std::string input_, name_;
    bool is_dropped_ = false;  // its file has another name for people than here
    std::shared_ptr<const Line> line_;
};

}  // namespace hogel::view
