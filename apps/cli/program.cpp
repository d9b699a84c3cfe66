// SPDX-License-Identifier: Apache-2.0
#include "program.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>

#include "hogel/error.h"
#include "hogel/resources.h"
#include "interrupts.h"

namespace hogel::cli {
namespace {

// Every failure is one line on stderr.
int fail(ErrorCode code, std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    write_error_stream(fmt::format("hogel: {}\n", message));
    return static_cast<int>(code);
}

// Reopens closed standard streams as ones that fail, so that no output file gets the number of such a stream and with
// it the stream's output.
void open_closed_streams() {
    for (const int stream : {0, 1, 2})
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

int run(std::span<const CommandInfo> commands, int argc, char** argv, Session& session) {
    CommandLine line(commands, session);
    session.arguments = argv;
    session.command = line.parse(argc, argv);
    if (session.command == nullptr) return 0;
    const ThreadLimit limit(session.threads);
    return session.command->run();
}

}  // namespace

int run_program(std::span<const CommandInfo> commands, int argc, char** argv) {
    open_closed_streams();
    Session session;
    const Interrupts interrupts(session.stop);
    int status = 0;
    try {
        status = run(commands, argc, argv, session);
    } catch (const Error& error) {
        if (interrupts.signal() != 0) {
            fail(ErrorCode::cancelled, "stopped");
            return 128 + interrupts.signal();
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

}  // namespace hogel::cli
