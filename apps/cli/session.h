// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>

#include "hogel/image.h"
#include "hogel/progress.h"
#include "result.h"

namespace hogel::cli {

class Command;

/// One run of the program: the options that all commands share, and the command that was chosen.
struct Session {
    bool quiet = false;
    bool verbose = false;
    bool json = false;          ///< results as JSON instead of words
    std::uint64_t threads = 0;  ///< 0: all
    std::uint64_t seed = 1;

    const Command* command = nullptr;
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
    std::stop_source stop;  ///< asks all work to end

    /// A line of words on stderr, unless -q; and one that only -v shows.
    void say(const std::string& line) const;
    void detail(const std::string& line) const;

    /// What the command found out or made, on the standard output: with --json as a JSON object, otherwise `words`,
    /// which may be empty where say() speaks of it.
    void result(const Result& result, const std::string& words = "") const;
    /// Since the program began.
    double seconds() const;
};

/// The options that every command has: -q, -v, --threads, --seed.
void add_common_options(Command& command, Session& session);
/// --json; every command has a result.
void add_json_flag(Command& command, Session& session);

/// What outputs carry with them: the version, the command, and the value of each of its options.
Metadata describe_run(const Session& session);

/// Writes to the standard error. That it cannot be written is no reason to fail.
void write_error_stream(const std::string& text);

/// One stage of the work: a bar on stderr where that is a terminal and the stage takes longer than a second.
class Stage {
  public:
    /// Throws Error(cancelled) where the work is to stop.
    Stage(const Session& session, std::string name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// For the library: stops the work after an interrupt, and draws the bar. Lives no longer than the stage. With
    /// (i, n), part i of n equal parts of the stage.
    Progress progress(std::size_t i = 0, std::size_t n = 1);
    double seconds() const;

  private:
    void draw(double fraction);
    void erase();

    using Clock = std::chrono::steady_clock;
    const Session& session_;
    std::string name_;
    bool on_terminal_;
    Clock::time_point began_ = Clock::now();
    Clock::time_point drawn_{};
    bool visible_ = false;
};

}  // namespace hogel::cli
