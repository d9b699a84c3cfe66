// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/bake.h"
#include "hogel/scenes.h"

namespace hogel::cli {

void add_scenes(CLI::App& app, Session& session) {
    add_command(app, session, "scenes", "List the built-in scenes", "  hogel scenes", [] {
        for (const SceneInfo& scene : scenes().rows()) fmt::print("{:<16} {}\n", scene.name, scene.text);
        return 0;
    });
}

}  // namespace hogel::cli
