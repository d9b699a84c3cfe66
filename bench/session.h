// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "hogel/progress.h"

namespace hogel::bench {

/// Options shared by commands. Tables go to the standard output, all other lines to stderr.
struct Session {
    bool quiet = false;
    bool verbose = false;

    /// Prints a line on stderr, unless --quiet.
    void say(const std::string& line) const;
    /// Prints a line on stderr only with --verbose.
    void detail(const std::string& line) const;
};

/// Installs handlers for Ctrl-C and SIGTERM: the first signal requests a stop, a later one ends the program at once.
void catch_interrupts();
/// Returns the signal that requested the stop, or 0.
int interrupted_by();
/// Throws Error(cancelled) after an interrupt.
void stop_if_interrupted();
/// Returns a Progress that stops the library's work after an interrupt.
Progress until_interrupted();

/// Creates the folder and its parents. Throws Error(cannot_write).
void create_folder(const std::filesystem::path& folder);
/// Writes a file atomically: it appears only when complete.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace hogel::bench
