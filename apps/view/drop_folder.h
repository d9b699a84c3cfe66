// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace hogel::view {

/// Temporary folders (mode 0700) of the files dropped on a page: one for the open files, one for incoming files.
class DropFolder {
  public:
    DropFolder() = default;
    /// Removes all folders.
    ~DropFolder();
    DropFolder(const DropFolder&) = delete;
    DropFolder& operator=(const DropFolder&) = delete;

    /// Returns the path for an incoming file. Throws Error(usage) unless `name` is a plain file name,
    /// Error(cannot_write) if no folder can be created.
    std::filesystem::path destination_for(const std::string& name);
    /// Marks the incoming files as open. The next files get a new folder.
    void opened();
    /// Removes the files that were open before.
    void forget_earlier();

  private:
    std::filesystem::path coming_, open_, earlier_;
};

}  // namespace hogel::view
