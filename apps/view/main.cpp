// SPDX-License-Identifier: Apache-2.0
// hogel-view: the program that `hogel view` executes. It has only this command, parsed as in hogel.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "cli/commands.h"
#include "cli/program.h"
#include "cli/view_options.h"
#include "hogel/error.h"
#include "view/browser.h"
#include "view/loader.h"
#include "view/settings.h"
#include "view/viewer.h"

namespace hogel::view {
namespace {

using cli::Session;

// Returns whether a command of hogel has an option.
bool takes(const std::string& command, std::string_view option) {
    static Session none;
    static const cli::CommandLine line(cli::commands(), none);
    return line.look_up(command)->look_up(option) != nullptr;
}

std::string address_of(const ViewerParameters& options, unsigned short port) {
    const std::string host = options.host.find(':') == std::string::npos ? options.host : "[" + options.host + "]";
    return fmt::format("http://{}:{}/{}", host, port, options.token.empty() ? "" : "?token=" + options.token);
}

int serve(const ViewerParameters& options, Session& session) {
    const Settings settings(*session.command, takes);
    ServerLimits limits;
    limits.body = static_cast<std::uint64_t>(options.memory * 1e9);
    Server server(options.host, static_cast<unsigned short>(options.port), limits);
    const auto viewer = std::make_shared<Viewer>(Access(options.host, server.port(), options.token));
    Loader loader(
        settings, *viewer, [&session](const std::string& line) { session.say(line); }, session.stop.get_token());
    loader.start([&session] { session.stop.request_stop(); });
    const std::string address = address_of(options, server.port());
    session.result({{"address", address}, {"port", server.port()}}, address + "\n");
    std::fflush(stdout);
    if (!options.no_browser) open_browser(address);
    viewer->set_controller(&loader);
    server.run(*viewer, session.stop.get_token());
    viewer->set_controller(nullptr);
    loader.finish();
    throw Error(ErrorCode::cancelled, "stopped");
}

void add_viewer(cli::Command& command, Session& session) {
    auto options = std::make_shared<ViewerParameters>();
    cli::add_view_options(command, *options);
    command.work([options, &session] { return serve(*options, session); });
}

}  // namespace
}  // namespace hogel::view

int main(int argc, char** argv) {
    static const hogel::cli::CommandInfo commands[] = {{"view", hogel::cli::view_summary, hogel::view::add_viewer}};
    return hogel::cli::run_program(commands, argc, argv);
}
