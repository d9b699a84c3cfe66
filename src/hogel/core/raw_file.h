// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace hogel::core {

/// A file that is read and written at offsets. Thread-safe.
class RawFile {
  public:
    /// `create` begins with an empty file, `kept` with what is there, if anything. An unnamed file is a new one in the
    /// folder that `path` names. It is gone when it is closed or the process ends.
    enum class Mode { read, write, create, kept, unnamed };
    /// Throws Error(bad_input) when reading, Error(cannot_write) otherwise.
    /// @param name  the file's name in error messages
    RawFile(const std::filesystem::path& path, Mode mode, const std::filesystem::path& name);
    ~RawFile();
    RawFile(const RawFile&) = delete;
    RawFile& operator=(const RawFile&) = delete;

    const std::filesystem::path& name() const { return name_; }
    std::uint64_t size() const;
    /// Throws Error(bad_input) if the file is too short.
    void read(std::uint64_t offset, void* to, std::size_t bytes) const;
    /// Throws Error(cannot_write).
    void write(std::uint64_t offset, const void* from, std::size_t bytes);
    /// Makes the file at least this long and reserves disk space if the file system supports it. Throws
    /// Error(cannot_write).
    void reserve(std::uint64_t bytes);
    /// Sets the length of the file; added bytes are a hole. Throws Error(cannot_write).
    void resize(std::uint64_t bytes);
    /// Takes the lock of the file until it is closed. Returns false if another RawFile has it, of any process.
    bool lock();
    /// Waits until all data has reached the disk. Throws Error(cannot_write).
    void flush();
    /// Throws Error(cannot_write) if the system reports a delayed failure.
    void close();

  private:
    [[noreturn]] void fail(int error) const;

    std::filesystem::path name_;
    Mode mode_;
    int file_ = -1;
};

/// Opens a new file without a name in a folder, for reading and writing. Returns its descriptor, or -1 with errno.
int open_unnamed(const std::filesystem::path& folder);

}  // namespace hogel::core
