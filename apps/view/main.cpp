// SPDX-License-Identifier: Apache-2.0
// hogel-view: what `hogel view` becomes. It has this one command, whose options are read as hogel reads them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "cli/program.h"
#include "cli/view_options.h"
#include "hogel/error.h"
#include "view/browser.h"
#include "view/loader.h"
#include "view/viewer.h"

namespace hogel::view {
namespace {

using cli::Session;
using cli::ViewOptions;

// A word of a command line as a shell reads it.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789._-+=,:/@%") == std::string::npos;
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

// `hogel photo` with the words of this command line that photographs have too, the input's options above all.
std::string photo_command(char* const* arguments, const ViewOptions& options, const std::string& input) {
    std::string command = "hogel photo";
    for (char* const* at = arguments + 2; *at != nullptr; ++at) {
        const std::string word = *at, name = word.substr(0, word.find('='));
        if (name == "--no-browser" || name == "--json") continue;
        if (name == "--port" || name == "--host" || name == "--token" || name == "--memory" || name == "--looks") {
            if (name == word && at[1] != nullptr) ++at;
            continue;
        }
        command += " " + quoted(word == options.input ? input : word);
    }
    return command;
}

std::string address_of(const ViewOptions& options, unsigned short port) {
    const std::string host = options.host.find(':') == std::string::npos ? options.host : "[" + options.host + "]";
    return fmt::format("http://{}:{}/{}", host, port, options.token.empty() ? "" : "?token=" + options.token);
}

int serve(const ViewOptions& options, Session& session) {
    const std::string input = cli::require_viewable(options);
    Server server(options.host, static_cast<unsigned short>(options.port));
    const auto viewer = std::make_shared<Viewer>(Access(options.host, server.port(), options.token), options.input,
                                                 photo_command(session.arguments, options, input));
    Loader loader(session, options, input, *viewer);
    loader.open();
    loader.load([&session] { session.stop.request_stop(); });
    const std::string address = address_of(options, server.port());
    session.result({{"address", address}, {"port", server.port()}}, address + "\n");
    std::fflush(stdout);
    if (!options.no_browser) open_browser(address);
    server.run(*viewer, session.stop.get_token());
    loader.finish();
    throw Error(ErrorCode::cancelled, "stopped");
}

void add_viewer(cli::Command& command, Session& session) {
    auto options = std::make_shared<ViewOptions>();
    cli::add_view_options(command, *options, session);
    command.work([options, &session] { return serve(*options, session); });
}

}  // namespace
}  // namespace hogel::view

int main(int argc, char** argv) {
    static const hogel::cli::CommandInfo commands[] = {{"view", hogel::cli::view_summary, hogel::view::add_viewer}};
    return hogel::cli::run_program(commands, argc, argv);
}
