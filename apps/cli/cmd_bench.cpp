// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

namespace hogel::cli {

void add_bench(CLI::App& app, Session& session) {
    CLI::App* bench = app.add_subcommand("bench", "Measure how fast and how good this is");
    bench->group("Commands")->require_subcommand(1);
    add_bench_render(*bench, session);
    add_bench_codec(*bench, session);
}

}  // namespace hogel::cli
