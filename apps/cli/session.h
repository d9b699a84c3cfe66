// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "hogel/progress.h"
#include "result.h"

namespace hogel::cli {

class Command;

/// One run of the program: the options common to all commands, and the chosen command.
struct Session {
    bool quiet = false;
    bool verbose = false;
    bool json = false;          ///< print results as JSON instead of text
    std::uint64_t threads = 0;  ///< 0: all
    std::uint64_t seed = 1;

    char* const* arguments = nullptr;  ///< of main()
    const Command* command = nullptr;
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
    std::stop_source stop;  ///< requests all work to stop

    /// Prints a line on stderr unless it is empty or -q is given. detail() requires -v.
    void say(const std::string& line) const;
    void detail(const std::string& line) const;

    /// Prints the result of the command on the standard output: with --json as a JSON object, otherwise as `words`.
    /// Empty `words`: say() has reported it.
    void result(const Result& result, const std::string& words = "") const;
    /// Returns the seconds since the start of the program.
    double seconds() const;
};

/// Adds the options of every command: -q, -v, --threads, --seed, --json.
void add_common_options(Command& command, Session& session);

/// Writes to the standard error and ignores failures.
void write_error_stream(const std::string& text);

/// One stage of the work. After a second it shows a progress bar on a terminal; elsewhere it prints its progress every
/// minute.
class Stage {
  public:
    /// Throws Error(cancelled) if a stop was requested.
    Stage(const Session& session, std::string name, std::chrono::milliseconds between_lines = std::chrono::minutes(1));
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Returns a Progress that stops the work after an interrupt and draws the bar. It must not outlive the stage.
    /// @param i, n  part i of n equal parts of the stage
    Progress progress(std::size_t i = 0, std::size_t n = 1);
    double seconds() const;

  private:
    void draw(double fraction);
    void erase();
    void report_lines(const std::stop_token& end, std::chrono::milliseconds between_lines);
    std::string time_left(double fraction) const;

    using Clock = std::chrono::steady_clock;
    const Session& session_;
    std::string name_;
    bool on_terminal_;
    Clock::time_point began_ = Clock::now();
    Clock::time_point drawn_{};
    bool visible_ = false;
    // Used without a terminal.
    std::atomic<double> fraction_ = 0;
    std::mutex mutex_;
    std::condition_variable_any ended_;
    std::jthread reporter_;
};

}  // namespace hogel::cli
