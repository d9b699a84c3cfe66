// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "command_line.h"
#include "hogel/error.h"
#include "hogel/printable.h"
#include "standard_output.h"

namespace hogel::cli {
namespace {

constexpr std::uint64_t max_threads = 4096;

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
    if (!quiet && !line.empty()) write_error_stream(printable(line) + "\n");
}

void Session::detail(const std::string& line) const {
    if (verbose) say(line);
}

void Session::result(const Result& result, const std::string& words) const {
    write_standard_output(json ? to_json(result) + "\n" : words);
}

double Session::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void add_common_options(Command& command, Session& session) {
    command.group(Command::last_group);
    command.flag("-q,--quiet", session.quiet, "Print only errors").never_acts();
    command.flag("-v,--verbose", session.verbose, "Print details: sizes and times of each stage").never_acts();
    command.whole("--threads", session.threads, max_threads, "Number of threads; 0: number of cores").never_acts();
    command
        .whole("--seed", session.seed, std::numeric_limits<std::uint64_t>::max(),
               "Seed of the random phases; equal seeds give equal bytes")
        .never_acts();
    command.flag("--json", session.json, "Print the result as a JSON object on the standard output").never_acts();
    command.group(Command::default_group);
}

void write_error_stream(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stderr) != text.size()) std::clearerr(stderr);
}

Stage::Stage(const Session& session, std::string name, std::chrono::milliseconds between_lines)
    : session_(session), name_(std::move(name)), on_terminal_(!session.quiet && isatty(STDERR_FILENO) != 0) {
    if (session.stop.stop_requested()) throw Error(ErrorCode::cancelled, "stopped on request");
    if (!on_terminal_ && !session.quiet)
        reporter_ = std::jthread([=, this](const std::stop_token& end) { report_lines(end, between_lines); });
}

Stage::~Stage() {
    if (reporter_.joinable()) {
        reporter_.request_stop();
        reporter_.join();
    }
    erase();
    session_.detail(fmt::format("{}: {:.2f} s", name_, seconds()));
}

Progress Stage::progress(std::size_t i, std::size_t n) {
    if (session_.quiet) return Progress(session_.stop.get_token());
    return Progress(session_.stop.get_token(), [this, i, n](double fraction) {
        const double total = std::clamp((static_cast<double>(i) + fraction) / static_cast<double>(n), 0.0, 1.0);
        fraction_ = total;
        if (on_terminal_) draw(total);
        return true;
    });
}

double Stage::seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

void Stage::report_lines(const std::stop_token& end, std::chrono::milliseconds between_lines) {
    for (;;) {
        std::unique_lock lock(mutex_);
        if (ended_.wait_for(lock, end, between_lines, [&] { return end.stop_requested(); })) return;
        session_.say(fmt::format("{}: {:.0f}%, {}", name_, std::floor(100 * fraction_), time_left(fraction_)));
    }
}

std::string Stage::time_left(double fraction) const {
    return fraction > 0.01 ? clock_text(seconds() * (1 - fraction) / fraction) + " left"
                           : clock_text(seconds()) + " so far";
}

void Stage::draw(double fraction) {
    const Clock::time_point now = Clock::now();
    if (now - began_ < std::chrono::seconds(1) || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    visible_ = true;
    const std::string words =
        fmt::format("{:<22.22} {:3.0f}%  {:>12}", name_, std::floor(100 * fraction), time_left(fraction));
    const std::size_t width = terminal_width();
    std::string bar;
    if (width > words.size() + 12) {
        const std::size_t cells = std::min<std::size_t>(width - words.size() - 4, 40);
        const auto done = static_cast<std::size_t>(fraction * static_cast<double>(cells));
        bar = fmt::format("  [{}{}]", std::string(done, '#'), std::string(cells - done, '.'));
    }
    write_error_stream("\r\033[K" + words + bar);
}

void Stage::erase() {
    if (visible_) write_error_stream("\r\033[K");
    visible_ = false;
}

}  // namespace hogel::cli
