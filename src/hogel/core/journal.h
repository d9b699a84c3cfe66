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

/// The notes of a long piece of work that may be interrupted and gone on with later: what the work is, and which parts
/// of it are done. A small text file; every line but the first carries a checksum of its own, so a journal that is
/// damaged or cut off anywhere never claims what is not so.
class Journal {
  public:
    /// What names a part: which of several outputs, its corner and its size, say.
    using Part = std::vector<std::uint64_t>;

    /// Takes up the journal at `path`, or prepares a new one where there is none.
    /// @param work  lines that tell this work from any other: its options, its inputs
    /// @param flush  brings the results of all parts so far to the disk; called before parts are written down as done
    /// Throws Error(usage) where the journal is of other work, and names the first difference; Error(bad_input) where
    /// it is no journal; Error(cannot_write) where it cannot be opened or another process is writing in it.
    Journal(const std::filesystem::path& path, std::vector<std::string> work, std::function<void()> flush);
    /// Writes down what is done.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Whether begin() was reached before.
    bool begun() const { return begun_; }
    /// Starts anew, with nothing done.
    void begin();
    /// Whether the part was done when this journal was taken up.
    bool was_done(const Part& part) const { return before_.contains(part); }
    /// To be called by any thread when a part is done.
    void note(const Part& part);
    /// The work is complete: removes the file.
    void remove();

  private:
    void read(const std::string& text);
    void append(const std::string& text);
    void write_down();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path path_;
    std::vector<std::string> work_;
    std::function<void()> flush_;
    int file_ = -1;
    bool begun_ = false;
    std::set<Part> before_;
    std::mutex mutex_;
    std::string pending_;  // lines of parts that are done and not yet written down
    std::chrono::steady_clock::time_point written_;
};

}  // namespace hogel::core
