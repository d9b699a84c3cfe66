// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "help.h"
#include "hogel/version.h"

namespace hogel::cli {
namespace {

volatile sig_atomic_t signal_seen = 0;
volatile time_t seen_at = 0;

// Wrappers such as timeout(1) send a signal twice at once, to the program and to its group; that counts as one. A
// second one later means it.
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

std::string clock_text(double seconds) {
    const auto s = static_cast<long>(std::lround(std::min(seconds, 359999.0)));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::size_t terminal_width() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

void Session::say(const std::string& line) const {
    if (!quiet) fmt::print(stderr, "{}\n", line);
}

void Session::detail(const std::string& line) const {
    if (verbose && !quiet) fmt::print(stderr, "{}\n", line);
}

CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      const std::string& examples, std::function<int()> run) {
    CLI::App* command = app.add_subcommand(name, description);
    command->group("Commands");
    command->footer("Examples:\n" + examples);
    command->add_flag("-q,--quiet", session.quiet, "Say nothing but errors")->group(HelpFormatter::last_group);
    command->add_flag("-v,--verbose", session.verbose, "Say more: sizes and times of each stage")
        ->group(HelpFormatter::last_group);
    command->add_option("--threads", session.threads, "Threads to use; 0: as many as there are cores")
        ->type_name("N")
        ->capture_default_str()
        ->group(HelpFormatter::last_group);
    command->add_option("--seed", session.seed, "Seed of the random phases; equal seeds give equal bytes")
        ->type_name("N")
        ->capture_default_str()
        ->group(HelpFormatter::last_group);
    command->get_option("--help")->group(HelpFormatter::last_group);
    command->callback([&session, command, run = std::move(run)] {
        session.command = command;
        session.run = run;
    });
    return command;
}

Metadata describe_run(const Session& session) {
    Metadata metadata{{"software", "hogel " HOGEL_VERSION}, {"command", "hogel " + session.command->get_name()}};
    for (const CLI::Option* option : session.command->get_options()) {
        const std::string name = option->get_single_name();
        // How many threads worked, how often, and how much was said does not touch the result: equal input, equal
        // bytes.
        constexpr std::array<std::string_view, 7> silent{"help",   "quiet",  "verbose", "threads",
                                                         "output", "resume", "region"};
        if (std::ranges::find(silent, name) != silent.end()) continue;
        const bool is_flag = option->get_expected_min() == 0;
        std::string value = option->count() > 0 ? CLI::detail::join(option->results(), " ") : option->get_default_str();
        if (is_flag) value = option->count() > 0 ? "yes" : "no";
        if (!value.empty()) metadata.emplace_back("option " + name, value);
    }
    return metadata;
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

Stage::Stage(const Session& session, std::string name)
    : session_(session), name_(std::move(name)), on_terminal_(!session.quiet && isatty(STDERR_FILENO) != 0) {
    if (interrupted_by() != 0) throw Error(ErrorCode::cancelled, "stopped on request");
}

Stage::~Stage() {
    erase();
    session_.detail(fmt::format("{}: {:.2f} s", name_, seconds()));
}

Progress Stage::progress(std::size_t i, std::size_t n) {
    return [this, i, n](double fraction) {
        if (on_terminal_) draw((static_cast<double>(i) + fraction) / static_cast<double>(n));
        return interrupted_by() == 0;
    };
}

double Stage::seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

void Stage::draw(double fraction) {
    const Clock::time_point now = Clock::now();
    if (now - began_ < std::chrono::seconds(1) || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    visible_ = true;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const std::string left =
        fraction > 0.01 ? clock_text(seconds() * (1 - fraction) / fraction) + " left" : clock_text(seconds());
    const std::string words = fmt::format("{:<22.22} {:3.0f}%  {:>12}", name_, std::floor(100 * fraction), left);
    const std::size_t width = terminal_width();
    std::string bar;
    if (width > words.size() + 12) {
        const std::size_t cells = std::min<std::size_t>(width - words.size() - 4, 40);
        const auto done = static_cast<std::size_t>(fraction * static_cast<double>(cells));
        bar = fmt::format("  [{}{}]", std::string(done, '#'), std::string(cells - done, '.'));
    }
    fmt::print(stderr, "\r\033[K{}{}", words, bar);
    std::fflush(stderr);
}

void Stage::erase() {
    if (visible_) fmt::print(stderr, "\r\033[K");
    visible_ = false;
}

}  // namespace hogel::cli
