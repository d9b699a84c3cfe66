// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace hogel::core {

/// A file that appears under its name only when it is complete. It is written as a temporary file in the target's
/// folder, which commit() renames and the destructor removes. A symbolic link is followed, so that its target is
/// replaced.
class OutputFile {
  public:
    /// Whether a file that is not committed is removed, or kept under the target's name with ".part" appended.
    enum class Unfinished { removed, kept };
    /// Throws Error(cannot_write) if the directory does not exist, or if the target exists and is not a regular file.
    explicit OutputFile(const std::filesystem::path& target, Unfinished unfinished = Unfinished::removed);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    const std::filesystem::path& target() const { return target_; }        ///< as given to the constructor
    const std::filesystem::path& temporary() const { return temporary_; }  ///< the file to write to
    /// Throws Error(cannot_write) when the temporary cannot be renamed.
    void commit();

  private:
    std::filesystem::path target_, final_name_, temporary_;
    Unfinished unfinished_;
    bool committed_ = false;
};

/// Writes a file, which appears under its name when it is complete. Throws Error(cannot_write).
void write_file(const std::filesystem::path& path, std::span<const unsigned char> bytes);

}  // namespace hogel::core
