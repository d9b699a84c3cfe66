// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "command_line.h"
#include "session.h"

namespace hogel::cli {

/// Returns all commands in the order of the help.
std::span<const CommandInfo> commands();

// Each function is in cmd_<name>.cpp and declares the options and the work of its command.
void add_make(Command& command, Session& session);
void add_bake(Command& command, Session& session);
void add_render(Command& command, Session& session);
void add_import(Command& command, Session& session);
void add_export(Command& command, Session& session);
void add_cameras(Command& command, Session& session);
void add_hologram(Command& command, Session& session);
void add_slm(Command& command, Session& session);
void add_print(Command& command, Session& session);
void add_photo(Command& command, Session& session);
void add_propagate(Command& command, Session& session);
void add_focus(Command& command, Session& session);
void add_compress(Command& command, Session& session);
void add_decompress(Command& command, Session& session);
void add_compare(Command& command, Session& session);
void add_join(Command& command, Session& session);
void add_info(Command& command, Session& session);
void add_scenes(Command& command, Session& session);
void add_view(Command& command, Session& session);
void add_completion(Command& command, Session& session);

}  // namespace hogel::cli
