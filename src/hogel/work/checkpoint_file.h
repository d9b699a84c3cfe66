// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/core/raw_file.h"

namespace hogel::work {

/// What a piece of work has done: a key that identifies the item, and the item's result, if the checkpoint keeps it.
///
/// A file of records: a line `hogel checkpoint 1`, the lines of the work, each after `work `, a line `records`, and for
/// each record, in little-endian numbers of 8 bytes, the checksum of what follows, the length of the key and of the
/// bytes, the key, and the bytes.
struct CheckpointRecord {
    std::vector<std::uint64_t> key;
    std::string bytes;

    /// As in the file.
    std::string encoded() const;
};

/// What precedes the bytes of a record in the file.
std::string checkpoint_record_head(const std::vector<std::uint64_t>& key, std::string_view bytes);
/// The length of that for a key of so many numbers.
constexpr std::size_t checkpoint_record_head_bytes(std::size_t numbers) {
    return (3 + numbers) * sizeof(std::uint64_t);
}

/// What precedes the records of a file.
/// @param work  lines that identify the work by its options and inputs
std::string checkpoint_header(const std::vector<std::string>& work);

/// Reads a file of records and changes nothing.
class CheckpointReader {
  public:
    /// @param kind  names such files in error messages
    /// Throws Error(bad_input) if it is no such file.
    CheckpointReader(const std::filesystem::path& path, std::string_view kind);

    const std::vector<std::string>& work() const { return work_; }
    /// The next record; none at the end of the file. Throws Error(bad_input) if it is damaged, incomplete, or has more
    /// than `max_bytes` bytes.
    std::optional<CheckpointRecord> read(std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max());
    /// Where the next record begins.
    std::uint64_t place() const { return next_; }
    std::uint64_t size() const { return file_.size(); }
    const std::filesystem::path& name() const { return file_.name(); }

  private:
    core::RawFile file_;
    std::vector<std::string> work_;
    std::uint64_t next_ = 0;
};

/// A file of records of long work that can be interrupted and resumed. The first record that is damaged or incomplete
/// ends the file, so that it never lists an item that is not done.
class CheckpointFile {
  public:
    /// Opens or creates the file, and locks it. An empty path keeps nothing.
    /// @param work  as of checkpoint_header()
    /// Throws Error(usage), with the first difference, if the file belongs to other work; Error(bad_input) if it is no
    /// such file; Error(cannot_write) if it cannot be opened or another process is writing to it.
    CheckpointFile(const std::filesystem::path& path, const std::vector<std::string>& work);

    /// The next record of earlier runs; none at the end. With `key` a record of another one is removed, with all that
    /// follow.
    std::optional<CheckpointRecord> read(const std::vector<std::uint64_t>* key = nullptr);
    /// Appends encoded records after the last one that was read; those that follow it are removed.
    void append(std::string_view records);
    /// Removes all records.
    void clear();
    /// Removes the file.
    void remove();
    bool is_open() const { return file_.has_value(); }

  private:
    void check_work(const std::vector<std::string>& work);
    void end_at(std::uint64_t place);

    std::optional<core::RawFile> file_;
    std::uint64_t first_ = 0, next_ = 0;  // places of the first record, and of the next one
    bool at_end_ = true;                  // nothing is left to be read
};

}  // namespace hogel::work
