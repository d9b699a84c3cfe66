// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hogel/error.h"
#include "hogel/parameters.h"

namespace hogel::cli {

struct Session;

/// One command of the program: a table of parameters, which become its options, and its work. An invalid value throws
/// Error(usage), which names the option.
class Command : public Parameters {
  public:
    Command(std::string name, std::string summary) : name_(std::move(name)), summary_(std::move(summary)) {}

    const std::string& name() const { return name_; }
    const std::string& summary() const { return summary_; }
    /// Sets the example command lines of the help, indented by two blanks.
    void examples(const std::string& lines) { examples_ = lines; }
    const std::string& examples() const { return examples_; }
    /// Options shown by the short --help in addition to the required ones. Empty: --help shows all options.
    const std::vector<std::string>& basics() const { return basics_; }
    void basics(std::vector<std::string> names) { basics_ = std::move(names); }
    bool is_basic(const Parameter& parameter) const;
    /// Sets the work, which returns the exit status.
    void work(std::function<int()> work) { work_ = std::move(work); }
    int run() const { return work_(); }

    /// Adds --like, for commands whose output files store their options.
    void add_like_option();
    /// Reads the file of --like. Throws Error(usage) if a required parameter has no value.
    void complete();
    void require_parameters() const;

    /// Extends Parameters::describe() by the options that come from the file of --like.
    std::string describe(const Error& error) const;

  private:
    std::string origins(const std::string& message) const;

    std::string name_, summary_, examples_, like_;
    std::vector<std::string> from_like_;
    std::vector<std::string> basics_;
    std::function<int()> work_;
};

/// Row of the table of commands.
struct CommandInfo {
    std::string name;
    std::string text;  ///< summary, one line
    void (*add)(Command& command, Session& session);
};

/// Command-line parser of the program and all its commands.
class CommandLine {
  public:
    CommandLine(std::span<const CommandInfo> commands, Session& session);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Parses the arguments of main() into the variables of the options. Returns the chosen command, or null after
    /// printing the help or the version on the standard output. Throws Error(usage).
    const Command* parse(int argc, const char* const* argv);

    std::vector<const Command*> commands() const;
    /// Returns the command of a name, or null.
    Command* look_up(const std::string& name) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::cli
