// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "hogel/parameters.h"

namespace hogel::cli {

class Command;

/// Layout of the help of the program.
class HelpFormatter final : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(24); }
    std::string make_usage(const CLI::App* app, std::string name) const override;
};

/// Returns the names of a parameter on the command line: "-o,--output", or a name without dashes.
std::string option_names(const Parameter& parameter);
/// Returns the help of a command. @param part  empty: three examples and the basic options; "all"; or the beginning of
/// a group's heading in lower case, with '-' for blanks: "light-field".
std::string help(const Command& command, const std::string& part);
/// Returns whether a word is "all" or the beginning of a group's heading.
bool has_group(const Command& command, const std::string& word);
/// Throws Error(usage) if the word is neither a group nor an option.
void require_group(const Command& command, const std::string& word);
/// Returns the parameters of a command as a JSON object.
std::string schema(const Command& command);

/// Returns a one-line message for a parse error, with a reference to the help.
std::string explain(const CLI::App& app, const CLI::ParseError& error);
/// Returns the message for an unknown command, with the nearest one and the list of all.
std::string explain_unknown_command(const CLI::App& app, const std::string& word);

}  // namespace hogel::cli
