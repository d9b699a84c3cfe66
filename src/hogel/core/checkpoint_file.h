// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hogel::core {

/// What a piece of work has done: a key that identifies the item, and the item's result, if the checkpoint keeps it.
struct CheckpointRecord {
    std::vector<std::uint64_t> key;
    std::string bytes;

    /// As in the file, with a checksum.
    std::string encoded() const;
};

/// A file of records of long work that can be interrupted and resumed. Each record has a checksum; the first one that
/// is damaged or incomplete ends the file, so that it never lists an item that is not done.
///
/// The file: a line `hogel checkpoint 1`, the lines of the work, each after `work `, a line `records`, and for each
/// record, in numbers of 8 bytes of this machine, the checksum of what follows, the length of the key and of the bytes,
/// the key, and the bytes.
class CheckpointFile {
  public:
    /// Opens or creates the file, and locks it. An empty path keeps nothing.
    /// @param work  lines that identify the work by its options and inputs
    /// Throws Error(usage), with the first difference, if the file belongs to other work; Error(bad_input) if it is no
    /// such file; Error(cannot_write) if it cannot be opened or another process is writing to it.
    CheckpointFile(const std::filesystem::path& path, const std::vector<std::string>& work);
    ~CheckpointFile();
    CheckpointFile(const CheckpointFile&) = delete;
    CheckpointFile& operator=(const CheckpointFile&) = delete;

    /// The next record of earlier runs; none at the end.
    std::optional<CheckpointRecord> read();
    /// Removes the record that was read last and all that follow.
    void reject();
    /// Appends encoded records after the last one that was read; those that follow it are removed.
    void append(std::string_view records);
    /// Removes all records.
    void clear();
    /// Removes the file.
    void remove();
    bool is_open() const { return file_ >= 0; }

  private:
    [[noreturn]] void fail(int error) const;
    void check_work(const std::string& header);
    bool read(void* to, std::size_t bytes);
    void write(std::string_view bytes);
    void end_at(std::uint64_t place);

    std::filesystem::path path_;
    int file_ = -1;
    std::uint64_t first_ = 0, last_ = 0, next_ = 0;  // places of the first record, the last one read, and the next
    bool at_end_ = true;                             // nothing is left to be read
};

}  // namespace hogel::core
