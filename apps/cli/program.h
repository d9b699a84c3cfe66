// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "command_line.h"
#include "hogel/error.h"
#include "session.h"

namespace hogel::cli {

/// How a run ended: the exit status, the kind of failure where it is one, and the line that is printed, if any.
struct Outcome {
    int status = 0;
    ErrorCode code = ErrorCode::internal;
    std::string message = {};
};

/// The processes of a program that runs each command in several.
class Processes {
  public:
    virtual ~Processes() = default;
    /// Called between the command line and the command. Errors end this process as those of the command do.
    virtual void begin(Session& session) = 0;
    /// What all processes come to, and what this one is to print of it.
    virtual Outcome end(const Outcome& own) = 0;
};

/// What main() does with a table of commands: reads the command line, runs the chosen command, and turns errors into
/// one line on the standard error and an exit status (docs/errors.md). To be called before any thread is started that
/// signals should not reach.
/// @param processes  null if there is one alone
int run_program(std::span<const CommandInfo> commands, int argc, char** argv, Processes* processes = nullptr);

/// Every failure is one line on stderr.
void print_failure(const std::string& message);

}  // namespace hogel::cli
