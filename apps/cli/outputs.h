// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "command_line.h"
#include "hogel/compress.h"
#include "hogel/scene.h"
#include "session.h"

namespace hogel::cli {

/// Complains now, not after an hour of work, about an output whose folder is missing or not writable.
void require_writable(const std::filesystem::path& file);

/// Writes a whole file, which appears when it is complete.
void write_text(const std::filesystem::path& file, const std::string& text);

/// --force, for folders that may hold the outputs of another run.
void add_force_flag(Command& command, bool& force);

/// --resume, for outputs that take long.
void add_resume_flag(Command& command, bool& resume);
/// What tells an input of work that is resumed from another: its name, and the size and date of a file.
std::string describe_input(const std::string& name);
/// The same of a scene, which may be told in several files, or in none: its name, and a checksum of all that it shows.
std::string describe_input(const std::string& name, const Scene& scene);

/// One line on a compressed light field, and one on its depth.
void say_what_was_compressed(const Session& session, const std::string& file, const CompressionResult& result);

/// A folder for the outputs of `hogel make` or `hogel print`. Creates it and those above it, and removes it again when
/// the work failed before anything was put into it.
class OutputFolder {
  public:
    /// Throws Error(cannot_write) where the folder cannot be created, or, without `force`, holds outputs of another
    /// run.
    OutputFolder(std::filesystem::path path, bool force);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool created_;
};

}  // namespace hogel::cli
