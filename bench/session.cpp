// SPDX-License-Identifier: Apache-2.0
#include "bench/session.h"

#include <fmt/format.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include "hogel/core/output_file.h"
#include "hogel/error.h"

namespace hogel::bench {
namespace {

volatile sig_atomic_t signal_seen = 0;
volatile time_t seen_at = 0;

// Wrappers such as timeout(1) send a signal twice, to the program and to its group. Both count as one request. Only a
// signal more than a second later ends the program at once.
extern "C" void note_signal(int signal) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (signal_seen == 0) {
        seen_at = now.tv_sec;
        signal_seen = signal;
    } else if (now.tv_sec > seen_at + 1) {
        _exit(128 + signal);
    }
}

}  // namespace

void Session::say(const std::string& line) const {
    if (!quiet) fmt::print(stderr, "{}\n", line);
}

void Session::detail(const std::string& line) const {
    if (verbose && !quiet) fmt::print(stderr, "{}\n", line);
}

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

int interrupted_by() { return signal_seen; }

void stop_if_interrupted() {
    if (interrupted_by() != 0) throw Error(ErrorCode::cancelled, "stopped");
}

Progress until_interrupted() {
    return Progress([](double) { return interrupted_by() == 0; });
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: cannot create this folder: {}", folder.string(),
                                                         error ? error.message() : "a file has its name"));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    core::write_file(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

}  // namespace hogel::bench
