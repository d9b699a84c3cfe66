// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "hogel/parameters.h"

namespace hogel::cli {

class Command;

/// The layout of the help of the whole program.
class HelpFormatter final : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(24); }
    std::string make_usage(const CLI::App* app, std::string name) const override;
};

/// What a parameter is called on the command line: "-o,--output", or a name without dashes.
std::string option_names(const Parameter& parameter);
/// The help of a command. @param part  empty: three examples and the basic options; "all"; or the beginning of a
/// group's heading in small letters, with '-' for blanks: "light-field".
std::string help(const Command& command, const std::string& part);
/// Whether a word is one of those: all, or the beginning of a group.
bool has_group(const Command& command, const std::string& word);
/// Throws Error(usage) where it is not, but for an option.
void require_group(const Command& command, const std::string& word);
/// Its parameters as a JSON object.
std::string schema(const Command& command);

/// A one-line message on what is wrong with a command line, with a reference to the help.
std::string explain(const CLI::App& app, const CLI::ParseError& error);
/// The message for an unknown command, with the nearest command and all that exist.
std::string explain_unknown_command(const CLI::App& app, const std::string& word);

}  // namespace hogel::cli
