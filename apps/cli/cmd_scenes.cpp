// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "hogel/scene.h"
#include "hogel/shading.h"

namespace hogel::cli {

namespace {

int list_scenes(const Session& session) {
    ResultList list;
    std::string words;
    for (const SceneInfo& scene : scenes().rows()) {
        list.push_back(Result{{"name", scene.name}, {"text", scene.text}});
        words += fmt::format("{:<16} {}\n", scene.name, scene.text);
    }
    session.result({{"scenes", list}}, words);
    return 0;
}

}  // namespace

void add_scenes(Command& command, Session& session) {
    command.examples("  hogel scenes");
    command.work([&session] { return list_scenes(session); });
}

}  // namespace hogel::cli
