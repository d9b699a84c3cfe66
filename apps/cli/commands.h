// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.h"

namespace hogel::cli {

// One file a command: cmd_<name>.cpp.
void add_make(CLI::App& app, Session& session);
void add_bake(CLI::App& app, Session& session);
void add_render(CLI::App& app, Session& session);
void add_hologram(CLI::App& app, Session& session);
void add_slm(CLI::App& app, Session& session);
void add_print(CLI::App& app, Session& session);
void add_photo(CLI::App& app, Session& session);
void add_propagate(CLI::App& app, Session& session);
void add_compress(CLI::App& app, Session& session);
void add_decompress(CLI::App& app, Session& session);
void add_compare(CLI::App& app, Session& session);
void add_info(CLI::App& app, Session& session);
void add_scenes(CLI::App& app, Session& session);

}  // namespace hogel::cli
