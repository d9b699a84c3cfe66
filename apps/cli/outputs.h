// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "hogel/pipeline.h"
#include "session.h"

namespace hogel::cli {

/// --resume, for outputs that take long.
void add_resume_flag(CLI::App* command, bool& resume);
/// One line on a compressed light field, and one on its depth.
void say_what_was_compressed(const Session& session, const std::string& file, const CompressionResult& result);

/// Creates a folder and those above it, and removes it again when the work failed before anything was put into it.
class OutputFolder {
  public:
    explicit OutputFolder(std::filesystem::path path);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool created_;
};

}  // namespace hogel::cli
