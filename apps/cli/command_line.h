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

/// One command of the program: its parameters, which are its options, and its work. An invalid value throws
/// Error(usage), which names the option.
class Command : public Parameters {
  public:
    Command(std::string name, std::string summary) : name_(std::move(name)), summary_(std::move(summary)) {}

    const std::string& name() const { return name_; }
    const std::string& summary() const { return summary_; }
    /// Command lines, indented by two blanks, that end the help.
    void examples(const std::string& lines) { examples_ = lines; }
    const std::string& examples() const { return examples_; }
    /// The options that --help shows beside the required ones, if there are too many to show all.
    const std::vector<std::string>& basics() const { return basics_; }
    void basics(std::vector<std::string> names) { basics_ = std::move(names); }
    bool is_basic(const Parameter& parameter) const;
    /// The work, which returns the exit status.
    void work(std::function<int()> work) { work_ = std::move(work); }
    int run() const { return work_(); }

    /// --like, for commands whose files say what made them.
    void add_like_option();
    /// Reads what --like names, and throws Error(usage) where a required parameter has no value.
    void complete();
    void require_parameters() const;

    /// As Parameters::describe(), with the options that the file of --like gave.
    std::string describe(const Error& error) const;

  private:
    std::string origins(const std::string& message) const;

    std::string name_, summary_, examples_, like_;
    std::vector<std::string> from_like_;
    std::vector<std::string> basics_;
    std::function<int()> work_;
};

/// A row of the table of commands.
struct CommandInfo {
    std::string name;
    std::string text;  ///< one line
    void (*add)(Command& command, Session& session);
};

/// The whole command line: what the program is and all its commands.
class CommandLine {
  public:
    CommandLine(std::span<const CommandInfo> commands, Session& session);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Reads the arguments of main() into the variables of the options. Returns the chosen command, or null after
    /// printing help or the version on the standard output. Throws Error(usage).
    const Command* parse(int argc, const char* const* argv);

    std::vector<const Command*> commands() const;
    /// The command of a name, or null.
    Command* look_up(const std::string& name) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hogel::cli
