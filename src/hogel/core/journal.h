// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace hogel::core {

/// A record of long work that may be interrupted and resumed: what the work is, and which parts of it are done. A small
/// text file; every line but the first has a checksum of its own, so that a journal that is damaged or cut off never
/// lists a part that is not done.
class Journal {
  public:
    /// Numbers that identify a part, such as which of several outputs, its corner and its size.
    using Part = std::vector<std::uint64_t>;

    /// Opens the journal at `path`, or creates it.
    /// @param work   lines that identify the work: its options, its inputs
    /// @param flush  brings the results of all parts so far to the disk; called before parts are recorded as done
    /// Throws Error(usage) where the journal belongs to other work, with the first difference; Error(bad_input) where
    /// it is no journal; Error(cannot_write) where it cannot be opened or another process is writing to it.
    Journal(const std::filesystem::path& path, std::vector<std::string> work, std::function<void()> flush);
    /// Records on the disk what is done.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Whether begin() was called for this work, in this run or an earlier one.
    bool begun() const { return begun_; }
    /// Starts anew, with nothing done.
    void begin();
    /// Whether the part was done when this journal was opened.
    bool was_done(const Part& part) const { return before_.contains(part); }
    /// Records that a part is done; any thread may call it. It reaches the disk within 20 seconds.
    void note(const Part& part);
    /// The work is complete: removes the file.
    void remove();

  private:
    void read(const std::string& text);
    void append(const std::string& text);
    void write_pending();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path path_;
    std::vector<std::string> work_;
    std::function<void()> flush_;
    int file_ = -1;
    bool begun_ = false;
    std::set<Part> before_;
    std::mutex mutex_;
    std::string pending_;  // lines of parts that are done and not yet on the disk
    std::chrono::steady_clock::time_point written_;
};

}  // namespace hogel::core
