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

/// A finished item of work: the key that identifies the item, and its result if the checkpoint keeps results.
///
/// A checkpoint file holds a line `hogel checkpoint 1`, lines that describe the work, each after `work `, a line
/// `records`, and the records. A record consists of the checksum of the rest, the number of key values, the number of
/// result bytes, the key, and the result bytes. All numbers are little-endian, 8 bytes.
struct CheckpointRecord {
    std::vector<std::uint64_t> key;
    std::string bytes;

    /// Returns the record as stored in the file.
    std::string encoded() const;
};

/// Returns the head of a record in the file: everything before the result bytes.
std::string checkpoint_record_head(const std::vector<std::uint64_t>& key, std::string_view bytes);
/// Returns the size in bytes of the head of a record with a key of `numbers` values.
constexpr std::size_t checkpoint_record_head_bytes(std::size_t numbers) {
    return (3 + numbers) * sizeof(std::uint64_t);
}

/// Returns the header of a checkpoint file: everything before the first record.
/// @param work  lines with the options and inputs of the work; a resumed run compares them with its own
std::string checkpoint_header(const std::vector<std::string>& work);

/// Read-only access to a checkpoint file.
class CheckpointReader {
  public:
    /// Throws Error(bad_input) if the file is not a checkpoint file.
    /// @param kind  noun for such files in error messages
    CheckpointReader(const std::filesystem::path& path, std::string_view kind);

    const std::vector<std::string>& work() const { return work_; }
    /// Returns the next record, or nothing at the end of the file. Throws Error(bad_input) if the record is damaged,
    /// incomplete, or longer than `max_bytes` bytes.
    std::optional<CheckpointRecord> read(std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max());
    /// Returns the offset of the next record, bytes.
    std::uint64_t place() const { return next_; }
    std::uint64_t size() const { return file_.size(); }
    const std::filesystem::path& name() const { return file_.name(); }

  private:
    core::RawFile file_;
    std::vector<std::string> work_;
    std::uint64_t next_ = 0;
};

/// Records of interruptible work. The file ends at the first damaged record: it never lists an unfinished item.
class CheckpointFile {
  public:
    /// Opens or creates the file, and locks it. With an empty path nothing is stored. Throws Error(usage), with the
    /// first difference, if the file belongs to other work; Error(bad_input) if it is not a checkpoint file;
    /// Error(cannot_write) if it cannot be opened or another process writes to it.
    /// @param work  as for checkpoint_header()
    CheckpointFile(const std::filesystem::path& path, const std::vector<std::string>& work);

    /// Returns the next record of earlier runs, or nothing at the end. If `key` is given and differs from the record's
    /// key, removes this record and all later ones.
    std::optional<CheckpointRecord> read(const std::vector<std::uint64_t>* key = nullptr);
    /// Appends encoded records after the last record read. Removes unread records.
    void append(std::string_view records);
    void clear();
    /// Removes the file.
    void remove();
    bool is_open() const { return file_.has_value(); }

  private:
    void check_work(const std::vector<std::string>& work);
    void truncate(std::uint64_t offset);

    std::optional<core::RawFile> file_;
    std::uint64_t first_ = 0, next_ = 0;  // offsets of the first and of the next record, bytes
    bool at_end_ = true;                  // no record is left to read
};

}  // namespace hogel::work
