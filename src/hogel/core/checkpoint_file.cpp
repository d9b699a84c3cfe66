// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/checkpoint_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "hogel/core/checksum.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

constexpr std::string_view first_line = "hogel checkpoint 1\n", last_line = "records\n";
constexpr std::uint64_t max_key = 64;  // numbers

// What precedes the key and the bytes of a record.
struct RecordHead {
    std::uint64_t checksum = 0, numbers = 0, bytes = 0;

    std::uint64_t body_bytes() const { return numbers * sizeof(std::uint64_t) + bytes; }
    // Of the lengths and of what follows the head.
    std::uint64_t checksum_of(std::string_view body) const {
        const auto octets = [](const void* data, std::size_t size) {
            return std::span(static_cast<const std::uint8_t*>(data), size);
        };
        const std::uint64_t all[] = {numbers, bytes, core::checksum(octets(body.data(), body.size()))};
        return core::checksum(octets(all, sizeof all));
    }
};

std::uint64_t size_of(int file) {
    struct stat status {};
    return ::fstat(file, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

}  // namespace

std::string CheckpointRecord::encoded() const {
    RecordHead head{0, key.size(), bytes.size()};
    std::string record(sizeof head, '\0');
    record.reserve(sizeof head + head.body_bytes());
    record.append(reinterpret_cast<const char*>(key.data()), key.size() * sizeof(std::uint64_t));
    record += bytes;
    head.checksum = head.checksum_of(std::string_view(record).substr(sizeof head));
    std::memcpy(record.data(), &head, sizeof head);
    return record;
}

CheckpointFile::CheckpointFile(const std::filesystem::path& path, const std::vector<std::string>& work) : path_(path) {
    if (path.empty()) return;
    std::string header(first_line);
    for (std::string line : work) {
        std::ranges::replace(line, '\n', ' ');
        header += fmt::format("work {}\n", line);
    }
    header += last_line;
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) fail(errno);
    try {
        if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': another process is", path_.string()));
        at_end_ = size_of(file_) == 0;
        at_end_ ? write(header) : check_work(header);
        first_ = last_ = next_ = header.size();
    } catch (...) {
        ::close(file_);
        throw;
    }
}

CheckpointFile::~CheckpointFile() {
    if (file_ >= 0) ::close(file_);
}

void CheckpointFile::fail(int error) const {
    throw Error(ErrorCode::cannot_write,
                fmt::format("cannot write '{}': {}", path_.string(), std::generic_category().message(error)));
}

// Reads the header, and compares it with that of this work.
void CheckpointFile::check_work(const std::string& header) {
    constexpr std::uint64_t longest = 1 << 20;
    std::string start(std::min(longest, size_of(file_)), '\0');
    if (read(start.data(), start.size()) && start.starts_with(header)) {
        if (::lseek(file_, static_cast<off_t>(header.size()), SEEK_SET) < 0) fail(errno);
        return;
    }
    std::istringstream has(start), needs(header);
    const auto of_work = [](const std::string& line) { return line.starts_with("work ") ? line.substr(5) : ""; };
    for (std::string was, is; start.starts_with(first_line) && std::getline(needs, is);) {
        if (!std::getline(has, was)) was.clear();
        if (of_work(was) == of_work(is)) continue;
        throw Error(ErrorCode::usage, fmt::format("cannot resume '{}': it was begun with '{}', not '{}'; remove it to "
                                                  "begin again",
                                                  path_.string(), of_work(was), of_work(is)));
    }
    throw Error(ErrorCode::bad_input, fmt::format("cannot resume '{}': it is no checkpoint of hogel; remove it to "
                                                  "begin again",
                                                  path_.string()));
}

bool CheckpointFile::read(void* to, std::size_t bytes) {
    for (std::size_t got = 0; got < bytes;) {
        const ssize_t more = ::read(file_, static_cast<char*>(to) + got, bytes - got);
        if (more == 0) return false;
        if (more > 0)
            got += static_cast<std::size_t>(more);
        else if (errno != EINTR)
            fail(errno);
    }
    return true;
}

void CheckpointFile::write(std::string_view bytes) {
    for (std::string_view rest = bytes; !rest.empty();) {
        const ssize_t put = ::write(file_, rest.data(), rest.size());
        if (put > 0)
            rest.remove_prefix(static_cast<std::size_t>(put));
        else if (errno != EINTR)
            fail(errno);
    }
}

void CheckpointFile::end_at(std::uint64_t place) {
    if (::ftruncate(file_, static_cast<off_t>(place)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) fail(errno);
    last_ = next_ = place;
    at_end_ = true;
}

std::optional<CheckpointRecord> CheckpointFile::read() {
    if (at_end_) return std::nullopt;
    RecordHead head;
    std::string body;
    bool is_whole = read(&head, sizeof head) && head.numbers <= max_key && head.bytes <= size_of(file_);
    if (is_whole) {
        body.resize(head.body_bytes());
        is_whole = read(body.data(), body.size()) && head.checksum == head.checksum_of(body);
    }
    if (!is_whole) {
        end_at(next_);
        return std::nullopt;
    }
    const std::size_t key_bytes = head.numbers * sizeof(std::uint64_t);
    CheckpointRecord record{std::vector<std::uint64_t>(head.numbers), {}};
    if (key_bytes > 0) std::memcpy(record.key.data(), body.data(), key_bytes);
    record.bytes = std::move(body.erase(0, key_bytes));
    last_ = next_;
    next_ += sizeof head + head.body_bytes();
    return record;
}

void CheckpointFile::reject() {
    if (file_ >= 0) end_at(last_);
}

void CheckpointFile::append(std::string_view records) {
    if (file_ < 0) return;
    if (!at_end_) end_at(next_);
    write(records);
    next_ += records.size();
}

void CheckpointFile::clear() {
    if (file_ >= 0) end_at(first_);
}

void CheckpointFile::remove() {
    if (file_ < 0) return;
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    ::close(std::exchange(file_, -1));
}

}  // namespace hogel::core
