// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "cli/view_options.h"

namespace hogel::view {

/// The command line of what is looked at. A page changes its options ("hogels", "rotate") and gets a command line
/// again, read as hogel reads every other. So what the page shows, what it copies and what hogel makes of that are the
/// same.
class Settings {
  public:
    using Words = std::map<std::string, std::string>;

    /// The program's own command line, "hogel-view view INPUT …".
    Settings(const cli::Session& session, const cli::ViewOptions& options);

    /// With other values of some options, and without those whose value is empty. Throws Error(usage) for an option
    /// that may not be changed, and for a value that hogel would refuse.
    Settings with(const Words& changes) const;
    /// The first command line with another input, by its name in command lines.
    Settings of(const std::string& file, const std::string& name) const;

    const cli::Session& session() const;
    const cli::ViewOptions& options() const;
    /// The file or scene to open: of a folder that hogel make wrote its light field.
    const std::string& input() const { return input_; }
    /// As the page names it.
    const std::string& name() const { return name_; }
    /// Whether both make the same light field: they differ in options of holograms alone.
    bool same_light_field(const Settings& other) const;

    /// `hogel photo` of this, without the camera; of the first layers of a stream behind `hogel decompress`.
    std::string photo_command() const;
    /// The same of the light field beside which errors are shown.
    std::string original_command() const;
    /// `hogel make` of this scene; with options of holograms that it does not have, `hogel hologram`.
    std::string make_command() const;

  private:
    struct Line;

    Settings() = default;
    static std::shared_ptr<Line> parsed(const std::vector<std::string>& words, const std::stop_source& stop);
    void read();
    std::string command(const std::string& command, const std::string& input) const;

    std::vector<std::string> first_, words_;  // options after "view" and the input
    std::string input_, name_;
    bool is_dropped_ = false;  // its file has another name for people than here
    std::shared_ptr<Line> line_;
};

}  // namespace hogel::view
