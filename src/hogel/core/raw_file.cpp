// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "hogel/core/raw_file.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

constexpr std::uint64_t max_bytes = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t max_transfer = std::size_t{1} << 30;  // one system call transfers a little less than 2 GiB

int flags(RawFile::Mode mode) {
    switch (mode) {
        case RawFile::Mode::read:
            return O_RDONLY | O_CLOEXEC;
        case RawFile::Mode::write:
            return O_RDWR | O_CLOEXEC;
        case RawFile::Mode::kept:
            return O_RDWR | O_CREAT | O_CLOEXEC;
        case RawFile::Mode::create:
        case RawFile::Mode::unnamed:
            break;
    }
    return O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC;
}

}  // namespace

RawFile::RawFile(const std::filesystem::path& path, Mode mode, const std::filesystem::path& name)
    : name_(name), mode_(mode) {
    std::error_code status;
    // Opening a pipe would block until its other end is opened.
    if (mode == Mode::read && std::filesystem::exists(path, status) && !std::filesystem::is_regular_file(path, status))
        throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': it is not a plain file", name_.string()));
    file_ = mode == Mode::unnamed ? open_unnamed(path) : ::open(path.c_str(), flags(mode), 0666);
    if (file_ < 0) fail(errno);
}

RawFile::~RawFile() {
    if (file_ >= 0) ::close(file_);
}

void RawFile::fail(int error) const {
    const std::string why = std::generic_category().message(error);
    if (mode_ == Mode::read)
        throw Error(ErrorCode::bad_input, fmt::format("cannot read '{}': {}", name_.string(), why));
    throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': {}", name_.string(), why));
}

std::uint64_t RawFile::size() const {
    struct stat status {};
    if (::fstat(file_, &status) != 0) fail(errno);
    return static_cast<std::uint64_t>(status.st_size);
}

void RawFile::read(std::uint64_t offset, void* to, std::size_t bytes) const {
    auto* destination = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t count = ::pread(file_, destination, std::min(bytes, max_transfer), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(errno);
        if (count == 0)
            throw Error(ErrorCode::bad_input,
                        fmt::format("cannot read '{}': it ends at byte {}", name_.string(), offset));
        destination += count;
        offset += static_cast<std::uint64_t>(count);
        bytes -= static_cast<std::size_t>(count);
    }
}

void RawFile::write(std::uint64_t offset, const void* from, std::size_t bytes) {
    const auto* source = static_cast<const char*>(from);
    while (bytes > 0) {
        const ssize_t count = ::pwrite(file_, source, std::min(bytes, max_transfer), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail(count < 0 ? errno : ENOSPC);
        source += count;
        offset += static_cast<std::uint64_t>(count);
        bytes -= static_cast<std::size_t>(count);
    }
}

void RawFile::reserve(std::uint64_t bytes) {
#ifdef __linux__
    if (bytes > max_bytes) fail(EFBIG);
    if (::fallocate(file_, 0, 0, static_cast<off_t>(bytes)) == 0) return;
    if (errno != EOPNOTSUPP && errno != ENOSYS && errno != EINTR) fail(errno);
#endif
    resize(std::max(bytes, size()));
}

void RawFile::resize(std::uint64_t bytes) {
    if (bytes > max_bytes) fail(EFBIG);
    if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail(errno);
}

bool RawFile::lock() { return ::flock(file_, LOCK_EX | LOCK_NB) == 0; }

void RawFile::flush() {
    if (::fdatasync(file_) != 0) fail(errno);
}

void RawFile::close() {
    if (::close(std::exchange(file_, -1)) != 0) fail(errno);
}

int open_unnamed(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
    if (const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600); file >= 0) return file;
#endif
    // For file systems without support for unnamed files.
    std::string name = (folder / ".hogel-XXXXXX.tmp").string();
    const int file = ::mkostemps(name.data(), 4, O_CLOEXEC);
    if (file >= 0) ::unlink(name.c_str());
    return file;
}

}  // namespace hogel::core
