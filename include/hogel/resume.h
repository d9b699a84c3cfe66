// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hogel/export.h"

namespace hogel {

namespace core {
class ResultLog;
}

/// While this object exists, the results of tiles that compress() and the narrow camera of photograph() merge in order
/// are kept in a file too. The same work, done again with the same file after it was interrupted, takes from it what
/// was merged and goes on with the next tile: the outcome has the same bytes. In a team the first process has the file,
/// and the number of processes may be another each time. HDF5 files have journals of their own instead
/// (LightFieldFileOptions::resume).
class HOGEL_API ResumeScope {
  public:
    /// @param work  lines that identify the work by its options and inputs
    ///              Throws Error(usage), with the first difference, if the file was begun by other work or another
    ///              scope exists; Error(bad_input) if it is no such file; Error(cannot_write) if it cannot be opened or
    ///              another process is writing to it.
    ResumeScope(const std::filesystem::path& file, const std::vector<std::string>& work);
    /// The file stays, for the next time, unless complete() was called or nothing was kept.
    ~ResumeScope();
    ResumeScope(const ResumeScope&) = delete;
    ResumeScope& operator=(const ResumeScope&) = delete;

    /// The work is complete: the file is removed.
    void complete();

  private:
    std::unique_ptr<core::ResultLog> log_;
};

}  // namespace hogel
