// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace hogel::core {

/// A file with reads and writes at offsets. Thread-safe.
class RawFile {
  public:
    /// `create` truncates an existing file; `kept` keeps its content. `unnamed` creates a file without a name in the
    /// folder `path`; it disappears when it is closed or the process ends.
    enum class Mode { read, write, create, kept, unnamed };
    /// Opens or creates a file. On failure throws Error(bad_input) for Mode::read, and Error(cannot_write) for other
    /// modes. Mode::read refuses a path that is not a regular file.
    /// @param name  name of the file in error messages
    RawFile(const std::filesystem::path& path, Mode mode, const std::filesystem::path& name);
    ~RawFile();
    RawFile(const RawFile&) = delete;
    RawFile& operator=(const RawFile&) = delete;

    const std::filesystem::path& name() const { return name_; }
    std::uint64_t size() const;
    /// Reads bytes at an offset. Throws Error(bad_input) if the file is too short.
    void read(std::uint64_t offset, void* to, std::size_t bytes) const;
    /// Writes bytes at an offset. Throws Error(cannot_write).
    void write(std::uint64_t offset, const void* from, std::size_t bytes);
    /// Extends the file to at least `bytes`; reserves disk space if possible. Throws Error(cannot_write).
    void reserve(std::uint64_t bytes);
    /// Sets the length of the file; added bytes are zero and take no disk space. Throws Error(cannot_write).
    void resize(std::uint64_t bytes);
    /// Locks the file until it is closed. Returns false if another RawFile of any process holds the lock.
    bool lock();
    /// Flushes all data to disk. Throws Error(cannot_write).
    void flush();
    /// Closes the file. Throws Error(cannot_write) if the system reports a delayed write error.
    void close();

  private:
    [[noreturn]] void fail(int error) const;

    std::filesystem::path name_;
    Mode mode_;
    int file_ = -1;
};

/// Opens a new file without a name in a folder, for reading and writing. Returns a descriptor, or -1 with errno set.
int open_unnamed(const std::filesystem::path& folder);

}  // namespace hogel::core
