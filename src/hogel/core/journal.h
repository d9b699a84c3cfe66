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

/// A record of long work that can be interrupted and resumed: which work it is, and which parts are done. It is a small
/// text file. Every line but the first has a checksum, so that a damaged or truncated journal never lists a part that
/// is not done.
class Journal {
  public:
    /// Numbers that identify a part, such as the index of the output, its corner and its size.
    using Part = std::vector<std::uint64_t>;

    /// Opens the journal at `path`, or creates it.
    /// @param work   lines that identify the work by its options and inputs
    /// @param flush  writes the results of all parts so far to the disk; called before parts are recorded as done
    ///               Throws Error(usage), with the first difference, if the journal belongs to other work;
    ///               Error(bad_input) if it is not a journal; Error(cannot_write) if it cannot be opened or another
    ///               process is writing to it.
    Journal(const std::filesystem::path& path, std::vector<std::string> work, std::function<void()> flush);
    /// The records of another process, which has the journal and knows that the parts `before` were done.
    /// @param send  sends it lines to append(), after `flush`
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
    /// Appends the lines of another process.
    void take(const std::string& lines);
    /// Removes the file, when the work is complete.
    void remove();

  private:
    void read(const std::string& text);
    void append(const std::string& text);
    void write_pending();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path path_;
    std::vector<std::string> work_;
    std::function<void()> flush_;
    std::function<void(const std::string&)> send_;  // of records that another process keeps
    int file_ = -1;
    bool begun_ = false;
    std::set<Part> before_;
    std::mutex mutex_;
    std::string pending_;  // lines of parts that are done but not yet on the disk
    std::chrono::steady_clock::time_point written_;
};

}  // namespace hogel::core
