// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hogel/work/checkpoint_file.h"

namespace hogel::work {

/// Which parts of a file of samples are written, in a CheckpointFile beside it. A part is listed only after its samples
/// are on the disk.
class Journal {
  public:
    /// Numbers that identify a part, such as the index of the output, its corner and its size.
    using Part = std::vector<std::uint64_t>;

    /// Opens or creates the journal. Throws as CheckpointFile does.
    /// @param work   lines that identify the work by its options and inputs
    /// @param flush  writes the samples of all parts so far to the disk; called before parts are recorded as done
    Journal(const std::filesystem::path& path, const std::vector<std::string>& work, std::function<void()> flush);
    /// The records of another process, which has the journal and knows that the parts `before` were done.
    /// @param send  sends it records for take(), after `flush`
    Journal(std::set<Part> before, std::function<void()> flush, std::function<void(const std::string&)> send);
    /// Writes pending records to the disk.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Whether begin() was called for this work, in this run or an earlier one.
    bool begun() const { return begun_; }
    /// Starts from the beginning, with no part done.
    void begin();
    /// Whether the part was done when this journal was opened.
    bool was_done(const Part& part) const { return before_.contains(part); }
    /// The parts that were done when this journal was opened.
    const std::set<Part>& before() const { return before_; }
    /// Records that a part is done, from any thread. The record reaches the disk within 20 seconds.
    void note(const Part& part);
    /// Writes pending records to the disk now.
    void write();
    /// Appends the records of another process.
    void take(const std::string& records);
    /// Removes the file, when the work is complete.
    void remove();

  private:
    void write_pending();

    std::optional<CheckpointFile> file_;  // none: another process has it
    std::function<void()> flush_;
    std::function<void(const std::string&)> send_;  // of records that another process keeps
    bool begun_ = false;
    std::set<Part> before_;
    std::mutex mutex_;
    std::string pending_;  // records of parts that are done but not yet on the disk
    std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace hogel::work
