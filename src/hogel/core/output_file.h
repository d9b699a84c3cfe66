// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

namespace hogel::core {

/// A file that appears under its name only when it is complete. Writes to a temporary file in the folder of the target;
/// commit() renames the temporary. Without commit(), the destructor removes the temporary unless Unfinished::kept is
/// given. Follows symbolic links. The next process that writes the same file removes the temporary of a killed process,
/// because the kernel has dropped its lock.
class OutputFile {
  public:
    /// Fate of a file without commit(): removed, or kept under the target's name with ".part" appended.
    enum class Unfinished { removed, kept };
    /// Creates the temporary. Throws Error(cannot_write) if that fails, or if the target exists and is no regular file.
    explicit OutputFile(const std::filesystem::path& target, Unfinished unfinished = Unfinished::removed);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    const std::filesystem::path& target() const { return target_; }        ///< path given to the constructor
    const std::filesystem::path& temporary() const { return temporary_; }  ///< the file to write to
    /// Renames the temporary to the target. Throws Error(cannot_write) if that fails.
    void commit();

  private:
    std::filesystem::path target_, final_name_, temporary_;
    Unfinished unfinished_;
    bool committed_ = false;
    int lock_ = -1;  // descriptor of the temporary; holds the lock
};

/// Throws Error(cannot_write) if an OutputFile of this target cannot be created: the target has no name, its directory
/// is missing or not writable, or it exists and is not a regular file. Creates no file; other failures remain possible.
void require_target(const std::filesystem::path& target);

/// Returns the folder of a target, with symbolic links followed. Throws as require_target() does.
std::filesystem::path folder_of(const std::filesystem::path& target);

/// Writes a file that appears under its name when it is complete. Throws Error(cannot_write).
void write_file(const std::filesystem::path& path, std::span<const unsigned char> bytes);

/// Writes several files that appear in a folder when all are complete. `write` fills a temporary folder inside this
/// folder, without subfolders. If `write` throws, the folder is unchanged. The temporary folder of a killed process is
/// removed by the next process that writes a set into the same folder. Throws Error(cannot_write).
void write_set(const std::filesystem::path& folder, const std::function<void(const std::filesystem::path&)>& write);

}  // namespace hogel::core
