// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

namespace hogel::core {

/// A file that appears under its name only when it is complete. It is written as a temporary file in the target's
/// folder, which commit() renames and the destructor removes. A symbolic link is followed, so that its target is
/// replaced. A process that is killed leaves its temporary; the next one that writes the same file removes it, which it
/// knows by a lock that the kernel drops with the process.
class OutputFile {
  public:
    /// Whether a file that is not committed is removed, or kept under the target's name with ".part" appended.
    enum class Unfinished { removed, kept };
    /// Creates the temporary. Throws Error(cannot_write) if that fails, or if the target exists and is not a regular
    /// file.
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
    int lock_ = -1;  // a descriptor of the temporary that holds the lock
};

/// Throws Error(cannot_write) where an OutputFile of this target could not be created, as far as that shows without
/// creating one: it has no name, its directory is missing or not writable, or it exists and is not a regular file.
void require_target(const std::filesystem::path& target);

/// The folder in which the file of a target is, behind a link. Throws as require_target() does.
std::filesystem::path folder_of(const std::filesystem::path& target);

/// Writes a file, which appears under its name when it is complete. Throws Error(cannot_write).
void write_file(const std::filesystem::path& path, std::span<const unsigned char> bytes);

/// Writes several files, which appear in a folder when all are complete. `write` fills a temporary folder inside it,
/// which holds no folders. If `write` throws, the folder is as it was. The temporary folder of a process that was
/// killed is removed by the next one that writes a set into the same folder. Throws Error(cannot_write).
void write_set(const std::filesystem::path& folder, const std::function<void(const std::filesystem::path&)>& write);

}  // namespace hogel::core
