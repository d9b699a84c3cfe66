// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>

#include "commands.h"
#include "help.h"
#include "hogel/core/parallel.h"
#include "hogel/error.h"
#include "hogel/version.h"
#include "session.h"

namespace {

using namespace hogel;
using namespace hogel::cli;

// Every failure is one line on stderr.
int fail(ErrorCode code, std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    fmt::print(stderr, "hogel: {}\n", message);
    return static_cast<int>(code);
}

void build(CLI::App& app, Session& session) {
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_version_flag("--version", "hogel " HOGEL_VERSION, "Print the version and exit");
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.require_subcommand(1);
    app.footer(
        "Lengths and angles have units: 16mm, 1.6um, 633nm, 20deg.\n"
        "SCENE is a mesh file (glTF, OBJ, PLY, STL and more) or the name of a built-in scene;\n"
        "depths are positive behind the hologram and negative in front of it.\n"
        "'hogel COMMAND --help' explains a command. Begin with:\n"
        "  hogel make pumpkin -o pumpkin");
    add_make(app, session);
    add_render(app, session);
    add_hologram(app, session);
    add_slm(app, session);
    add_print(app, session);
    add_photo(app, session);
    add_propagate(app, session);
    add_compress(app, session);
    add_decompress(app, session);
    add_compare(app, session);
    add_info(app, session);
    add_bake(app, session);
    add_scenes(app, session);
}

int run(int argc, char** argv) {
    CLI::App app{"hogel: full-parallax holographic stereograms, from scene to photograph", "hogel"};
    Session session;
    build(app, session);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : fail(ErrorCode::usage, explain(app, error));
    }
    const ThreadLimit limit(session.threads);
    return session.run();
}

}  // namespace

int main(int argc, char** argv) {
    catch_interrupts();
    int status = 0;
    try {
        status = run(argc, argv);
    } catch (const Error& error) {
        if (interrupted_by() != 0) {
            fail(ErrorCode::cancelled, "stopped");
            return 128 + interrupted_by();
        }
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::internal, "out of memory");
    } catch (const std::exception& error) {
        return fail(ErrorCode::internal, fmt::format("internal error: {}", error.what()));
    }
    if (std::fflush(stdout) != 0) return fail(ErrorCode::cannot_write, "cannot write to the standard output");
    return status;
}
