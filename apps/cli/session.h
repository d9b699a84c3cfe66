// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "hogel/image.h"
#include "hogel/progress.h"

namespace hogel::cli {

/// One run of the program: what every command can be told, and the command that was chosen.
struct Session {
    bool quiet = false;
    bool verbose = false;
    std::size_t threads = 0;  ///< 0: all
    std::uint64_t seed = 1;

    const CLI::App* command = nullptr;
    std::function<int()> run;  ///< does the work and returns the exit status

    /// A line of words on stderr, unless -q; and one that only -v shows.
    void say(const std::string& line) const;
    void detail(const std::string& line) const;
};

/// Creates a command with the options that all share. `run` is called after the whole command line has been read.
CLI::App* add_command(CLI::App& app, Session& session, const std::string& name, const std::string& description,
                      const std::string& examples, std::function<int()> run);

/// What outputs carry with them: the version, the command, and the value of each of its options.
Metadata describe_run(const Session& session);

/// From now on Ctrl-C and SIGTERM ask the work to stop; a second one, later, ends the program at once.
void catch_interrupts();
/// The signal that asked for it, or 0.
int interrupted_by();

/// One stage of the work: a bar on stderr where that is a terminal and the stage takes longer than a second.
class Stage {
  public:
    Stage(const Session& session, std::string name);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// To be handed to the library: draws the bar, and stops the work after an interrupt. Lives no longer than the
    /// stage. With (i, n), the i-th of n equal parts of the stage.
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
