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

/// Stores results in a checkpoint file while the object exists, so that interrupted work can be continued. Stored are
/// the results of tiles that compress() and photograph() with BandSource::samples merge in order, each colour's
/// photograph by other camera models, photographs by rays, and the patterns of encode_patterns(). The same work,
/// repeated with the same file, continues with the stored results and gives the same bytes. The root rank owns the
/// file; the number of ranks may change between runs. HDF5 files have journals of their own instead
/// (LightFieldFileOptions::resume).
class HOGEL_API ResumeScope {
  public:
    /// Opens or creates the checkpoint file. Throws Error(usage) if the file belongs to other work, with the first
    /// difference, or if another scope exists; Error(bad_input) if it is not a checkpoint file; Error(cannot_write) if
    /// it cannot be opened or another process is writing to it.
    /// @param work  lines that identify the work by its options and inputs
    ResumeScope(const std::filesystem::path& file, const std::vector<std::string>& work);
    /// Keeps the file for the next run, unless complete() was called or nothing was stored.
    ~ResumeScope();
    ResumeScope(const ResumeScope&) = delete;
    ResumeScope& operator=(const ResumeScope&) = delete;

    /// Runs a step whose results are in files of their own, unless an earlier run has completed it. All ranks call it.
    void once(const std::function<void()>& work);
    /// Removes the file, because the work is complete.
    void complete();

  private:
    std::unique_ptr<work::ResultLog> log_;
};

}  // namespace hogel
