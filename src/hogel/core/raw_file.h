// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace hogel::core {

/// A file that is read and written at offsets, by any number of threads at once.
class RawFile {
  public:
    enum class Mode { read, write, create };
    /// @param name  of the file in error messages
    /// Throws Error(bad_input) when reading, Error(cannot_write) otherwise.
    RawFile(const std::filesystem::path& path, Mode mode, const std::filesystem::path& name);
    ~RawFile();
    RawFile(const RawFile&) = delete;
    RawFile& operator=(const RawFile&) = delete;

    const std::filesystem::path& name() const { return name_; }
    std::uint64_t size() const;
    /// Throws Error(bad_input) where the file ends before that.
    void read(std::uint64_t offset, void* to, std::size_t bytes) const;
    /// Throws Error(cannot_write).
    void write(std::uint64_t offset, const void* from, std::size_t bytes);
    /// Makes the file at least this long and reserves room on the disk where the file system can. Throws
    /// Error(cannot_write).
    void reserve(std::uint64_t bytes);
    /// Makes the file this long; what is added is a hole. Throws Error(cannot_write).
    void resize(std::uint64_t bytes);
    /// Returns when all that was written has reached the disk. Throws Error(cannot_write).
    void flush();
    /// Throws Error(cannot_write) when the system reports a late failure.
    void close();

  private:
    [[noreturn]] void fail(int error) const;

    std::filesystem::path name_;
    Mode mode_;
    int file_ = -1;
};

}  // namespace hogel::core
