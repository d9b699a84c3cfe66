// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hogel::cli {

/// The layout of --help: the usage on one line, groups of options with those shared by all commands last, and defaults
/// in brackets after the description.
class HelpFormatter final : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(24); }
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
    std::string make_positionals(const CLI::App* app) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

/// A one-line message on what is wrong with a command line, with a reference to the help.
std::string explain(const CLI::App& app, const CLI::ParseError& error);
/// The message for an unknown command, with the nearest command and all that exist.
std::string explain_unknown_command(const CLI::App& app, const std::string& word);

}  // namespace hogel::cli
