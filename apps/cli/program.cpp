// SPDX-License-Identifier: Apache-2.0
#include "program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "command_line.h"
#include "hogel/error.h"
#include "hogel/printable.h"
#include "hogel/progress.h"
#include "hogel/resources.h"
#include "interrupts.h"
#include "standard_output.h"

namespace hogel::cli {
namespace {

// Reopens closed standard streams such that using them fails. Otherwise an output file could get the descriptor of a
// standard stream and receive its output.
void open_closed_streams() {
    for (const int stream : {0, 1, 2})
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

int run(std::span<const CommandInfo> commands, int argc, char** argv, Session& session, Processes* processes) {
    CommandLine line(commands, session);
    session.arguments = argv;
    session.command = line.parse(argc, argv);
    if (session.command == nullptr) return 0;
    if (processes != nullptr) processes->begin(session);
    const ThreadLimit limit(session.threads);
    const Stoppable stoppable(Progress(session.stop.get_token()));
    try {
        return session.command->run();
    } catch (const Error& error) {  // here, because `line` owns the command
        throw Error(error.code(), session.command->describe(error));
    }
}

Outcome failure(ErrorCode code, const std::string& message) { return {static_cast<int>(code), code, message}; }

Outcome outcome_of(std::span<const CommandInfo> commands, int argc, char** argv, Processes* processes) {
    Session session;
    const Interrupts interrupts(session.stop);
    Outcome outcome;
    try {
        outcome.status = run(commands, argc, argv, session, processes);
        require_written(std::fflush(stdout) == 0);
    } catch (const ClosedPipe&) {
        outcome.status = 128 + SIGPIPE;
    } catch (const Error& error) {
        outcome = failure(error.code(), error.what());
        if (interrupts.signal() != 0) outcome = {128 + interrupts.signal(), ErrorCode::cancelled, "stopped"};
    } catch (const std::bad_alloc&) {
        outcome = failure(ErrorCode::internal, "out of memory");
    } catch (const std::exception& error) {
        outcome = failure(ErrorCode::internal, fmt::format("internal error: {}", error.what()));
    }
    return processes != nullptr ? processes->end(outcome) : outcome;
}

}  // namespace

void print_failure(const std::string& message) { write_error_stream(fmt::format("hogel: {}\n", printable(message))); }

int run_program(std::span<const CommandInfo> commands, int argc, char** argv, Processes* processes) {
    // Returns blocks of 4 MiB and more to the system when they are freed. By default malloc raises this threshold up to
    // 32 MiB when such a block is freed, which fragments memory. Setting it also freezes the trim threshold, whose
    // default would return the end of each thread's heap at once; the next block would need those pages cleared again.
    mallopt(M_MMAP_THRESHOLD, 4 << 20);
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
    open_closed_streams();
    const Outcome outcome = outcome_of(commands, argc, argv, processes);
    if (!outcome.message.empty()) print_failure(outcome.message);
    return outcome.status;
}

}  // namespace hogel::cli
