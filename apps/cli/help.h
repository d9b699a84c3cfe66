// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hogel::cli {

/// How --help looks: the usage on one line as it would be typed, groups of options with what all commands share at the
/// end, and defaults in brackets after the words.
class HelpFormatter final : public CLI::Formatter {
  public:
    HelpFormatter() { column_width(24); }
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
    std::string make_positionals(const CLI::App* app) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

/// What is wrong with a command line, in one line, and where to read on.
std::string explain(const CLI::App& app, const CLI::ParseError& error);
/// There is no such command: which one may have been meant, and which ones exist.
std::string explain_unknown_command(const CLI::App& app, const std::string& word);

}  // namespace hogel::cli
