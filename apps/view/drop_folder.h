// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace hogel::view {

/// Where files lie that were dropped on a page: folders below that of temporary files that no other user can enter, one
/// for the files that are shown and one for those that come.
class DropFolder {
  public:
    DropFolder() = default;
    /// Removes all of it.
    ~DropFolder();
    DropFolder(const DropFolder&) = delete;
    DropFolder& operator=(const DropFolder&) = delete;

    /// Where a file of that name is to be put. Throws Error(usage) for what is no plain name of a file,
    /// Error(cannot_write).
    std::filesystem::path destination_for(const std::string& name);
    /// The files that came are opened now; the next ones get a folder of their own.
    void opened();
    /// What was opened before them is no longer shown.
    void forget_earlier();

  private:
    std::filesystem::path coming_, open_, earlier_;
};

}  // namespace hogel::view
