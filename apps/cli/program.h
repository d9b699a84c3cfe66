// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "command_line.h"
#include "hogel/error.h"
#include "session.h"

namespace hogel::cli {

/// Result of a run: the exit status, the kind of failure, and the error message; empty: none.
struct Outcome {
    int status = 0;
    ErrorCode code = ErrorCode::internal;
    std::string message = {};
};

/// Ranks of a program that runs each command in several processes.
class Processes {
  public:
    virtual ~Processes() = default;
    /// Called between parsing the command line and running the command. Errors are handled like those of the command.
    virtual void begin(Session& session) = 0;
    /// Combines the outcomes of all ranks. Returns the common outcome with the message that this rank prints.
    virtual Outcome end(const Outcome& local) = 0;
};

/// Implements main() for a table of commands: parses the command line, runs the command, and converts errors to one
/// line on the standard error and an exit status (docs/errors.md). Must be called before threads start that must not
/// receive signals.
/// @param processes  null: a single process
int run_program(std::span<const CommandInfo> commands, int argc, char** argv, Processes* processes = nullptr);

/// Prints an error message as one line on stderr.
void print_failure(const std::string& message);

}  // namespace hogel::cli
