// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hogel/export.h"

namespace hogel {

namespace work {
class ResultLog;
}

/// While this object exists, what takes long is kept in a file too as soon as it is made: the results of tiles that
/// compress() and the narrow camera of photograph() merge in order, the photographs of one colour by other cameras,
/// those by rays, and patterns of encode_patterns(). The same work, done again with the same file after it was
/// interrupted, takes from it what was made and goes on: the outcome has the same bytes. In a team the first process
/// has the file, and the number of processes may be another each time. HDF5 files have journals of their own instead
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

    /// Does a piece of work whose results are in files of their own, unless it was done the last time. All processes of
    /// a team call it.
    void once(const std::function<void()>& work);
    /// The work is complete: the file is removed.
    void complete();

  private:
    std::unique_ptr<work::ResultLog> log_;
};

}  // namespace hogel
