// SPDX-License-Identifier: Apache-2.0
// The viewer is a separate program in the same folder, because only it links a server. It parses the same command line.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "commands.h"
#include "hogel/error.h"
#include "view_options.h"

namespace hogel::cli {
namespace {

std::filesystem::path viewer() {
    std::error_code ignored;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    std::filesystem::path program = self.parent_path() / "hogel-view";
    if (!self.empty() && std::filesystem::exists(program, ignored)) return program;
    throw Error(ErrorCode::not_built_in,
                "view: this build of hogel lacks the viewer, hogel-view; build with HOGEL_VIEW=ON and the package "
                "libboost-dev");
}

int view(const ViewerParameters& options, const Session& session) {
    const std::filesystem::path program = viewer();
    options.viewable();
    execv(program.c_str(), session.arguments);
    throw Error(ErrorCode::not_built_in,
                fmt::format("{}: cannot be started: {}", program.string(), std::strerror(errno)));
}

}  // namespace

void add_view(Command& command, Session& session) {
    auto options = std::make_shared<ViewerParameters>();
    add_view_options(command, *options);
    command.work([options, &session] { return view(*options, session); });
}

}  // namespace hogel::cli
