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

/// Checkpoint file that lists the written parts of a file of samples. Lists a part only after its samples are on disk.
class Journal {
  public:
    /// Numbers that identify a part, e.g. index of the output, corner and size.
    using Part = std::vector<std::uint64_t>;

    /// Opens or creates the journal. Throws as CheckpointFile does.
    /// @param work   lines that identify the work by its options and inputs
    /// @param flush  writes the samples of all finished parts to disk; called before their records are written
    Journal(const std::filesystem::path& path, const std::vector<std::string>& work, std::function<void()> flush);
    /// A journal on a rank that does not own the file.
    /// @param before  parts that were done when the owner opened the file
    /// @param send    sends records to the owner, which calls take(); called after `flush`
    Journal(std::set<Part> before, std::function<void()> flush, std::function<void(const std::string&)> send);
    /// Writes pending records to the disk.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Returns whether begin() was called for this work, in this run or an earlier one.
    bool begun() const { return begun_; }
    /// Restarts with an empty list of parts.
    void begin();
    /// Returns whether the part was done when this journal was opened.
    bool was_done(const Part& part) const { return before_.contains(part); }
    /// Returns the parts that were done when this journal was opened.
    const std::set<Part>& before() const { return before_; }
    /// Records a finished part. Thread-safe. The record reaches the disk within 20 seconds.
    void note(const Part& part);
    /// Writes pending records to the disk now.
    void write();
    /// Appends the records of another rank.
    void take(const std::string& records);
    /// Removes the file. Called when the work is complete.
    void remove();

  private:
    void write_pending();

    std::optional<CheckpointFile> file_;  // empty if another rank owns the file
    std::function<void()> flush_;
    std::function<void(const std::string&)> send_;  // sends records to the owner
    bool begun_ = false;
    std::set<Part> before_;
    std::mutex mutex_;
    std::string pending_;  // records of finished parts that are not on disk yet
    std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace hogel::work
