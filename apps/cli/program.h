// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "command_line.h"
#include "session.h"

namespace hogel::cli {

/// What main() does with a table of commands: reads the command line, runs the chosen command, and turns errors into
/// one line on the standard error and an exit status (docs/errors.md). To be called before any thread is started.
int run_program(std::span<const CommandInfo> commands, int argc, char** argv);

}  // namespace hogel::cli
