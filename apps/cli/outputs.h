// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "command_line.h"
#include "hogel/pipeline.h"
#include "session.h"

namespace hogel::cli {

/// --force, for folders that may hold the outputs of another run.
void add_force_flag(Command& command, bool& force);

/// --resume, for outputs that take long.
void add_resume_flag(Command& command, bool& resume);
/// Prints a line about a compressed light field, and one about its depth.
void say_what_was_compressed(const Session& session, const std::string& file, const CompressionResult& result);

/// A folder for the outputs of `hogel make` or `hogel print`. Creates it with its parents, and removes it if the work
/// fails before anything is written to it.
class OutputFolder {
  public:
    /// Throws Error(cannot_write) if the folder cannot be created or, without `force`, if it holds outputs of another
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
