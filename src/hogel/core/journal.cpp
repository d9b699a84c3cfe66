// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "hogel/core/checksum.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

constexpr std::string_view journal_heading = "hogel journal 1";
// The time between writes, which is the maximum of work that is lost when the machine stops.
constexpr std::chrono::seconds between_writes{20};

std::uint32_t checksum_of(std::string_view text) {
    return checksum({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string with_checksum(std::string_view line) { return fmt::format("{:08x} {}\n", checksum_of(line), line); }

// Removes the checksum from a line. Returns false if it is wrong.
bool take_checksum(std::string& line) {
    if (line.size() < 9 || line[8] != ' ') return false;
    const std::string sum = line.substr(0, 8);
    line.erase(0, 9);
    return sum == fmt::format("{:08x}", checksum_of(line));
}

}  // namespace

Journal::Journal(const std::filesystem::path& path, std::vector<std::string> work, std::function<void()> flush)
    : path_(path), work_(std::move(work)), flush_(std::move(flush)) {
    for (std::string& line : work_) std::ranges::replace(line, '\n', ' ');
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) fail(errno);
    try {
        if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': another process is", path_.string()));
        std::string text;
        char buffer[1 << 16];
        for (ssize_t got = 0; (got = ::read(file_, buffer, sizeof buffer)) != 0;) {
            if (got > 0)
                text.append(buffer, static_cast<std::size_t>(got));
            else if (errno != EINTR)
                fail(errno);
        }
        if (!text.empty()) read(text);
        written_ = std::chrono::steady_clock::now();
    } catch (...) {
        ::close(file_);
        throw;
    }
}

Journal::Journal(std::set<Part> before, std::function<void()> flush, std::function<void(const std::string&)> send)
    : flush_(std::move(flush)),
      send_(std::move(send)),
      begun_(true),
      before_(std::move(before)),
      written_(std::chrono::steady_clock::now()) {}

Journal::~Journal() {
    try {
        write();
    } catch (const Error&) {
        // Ignored: parts that are not recorded will only be done again.
    }
    if (file_ >= 0) ::close(file_);
}

void Journal::fail(int error) const {
    throw Error(ErrorCode::cannot_write,
                fmt::format("cannot write '{}': {}", path_.string(), std::generic_category().message(error)));
}

void Journal::read(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || line != journal_heading)
        throw Error(ErrorCode::bad_input, fmt::format("cannot resume '{}': it is not a journal of hogel; remove it and "
                                                      "the file beside it to begin again",
                                                      path_.string()));
    std::size_t known = 0, end = journal_heading.size() + 1;
    // The first line that is damaged or incomplete, and all lines after it, are ignored.
    while (std::getline(lines, line) && !lines.eof()) {
        const std::size_t length = line.size() + 1;
        if (!take_checksum(line)) break;
        end += length;
        if (line.starts_with("work ")) {
            const std::string was = line.substr(5), is = known < work_.size() ? work_[known] : "";
            if (was != is)
                throw Error(ErrorCode::usage, fmt::format("cannot resume '{}': it was begun with '{}', not '{}'; "
                                                          "remove it to begin again",
                                                          path_.string(), was, is));
            ++known;
        } else if (line == "begin") {
            begun_ = known == work_.size();
        } else if (line.starts_with("done ")) {
            std::istringstream numbers(line.substr(5));
            Part part;
            for (std::uint64_t number = 0; numbers >> number;) part.push_back(number);
            before_.insert(std::move(part));
        }
    }
    // New lines follow the last valid one.
    if (::ftruncate(file_, static_cast<off_t>(end)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) fail(errno);
    if (!begun_) before_.clear();
}

void Journal::begin() {
    if (::ftruncate(file_, 0) != 0 || ::lseek(file_, 0, SEEK_SET) != 0) fail(errno);
    before_.clear();
    std::string text = fmt::format("{}\n", journal_heading);
    for (const std::string& line : work_) text += with_checksum("work " + line);
    append(text + with_checksum("begin"));
    written_ = std::chrono::steady_clock::now();
    begun_ = true;
}

void Journal::append(const std::string& text) {
    for (std::string_view rest = text; !rest.empty();) {
        const ssize_t put = ::write(file_, rest.data(), rest.size());
        if (put > 0)
            rest.remove_prefix(static_cast<std::size_t>(put));
        else if (errno != EINTR)
            fail(errno);
    }
}

void Journal::write_pending() {
    if (pending_.empty()) return;
    flush_();
    const std::string lines = std::exchange(pending_, {});
    if (send_)
        send_(lines);
    else
        append(lines);
    written_ = std::chrono::steady_clock::now();
}

void Journal::note(const Part& part) {
    const std::lock_guard lock(mutex_);
    pending_ += with_checksum(fmt::format("done {}", fmt::join(part, " ")));
    if (std::chrono::steady_clock::now() - written_ >= between_writes) write_pending();
}

void Journal::write() {
    const std::lock_guard lock(mutex_);
    if (file_ >= 0 || send_) write_pending();
}

void Journal::take(const std::string& lines) {
    const std::lock_guard lock(mutex_);
    if (file_ >= 0) append(lines);
}

void Journal::remove() {
    const std::lock_guard lock(mutex_);
    send_ = nullptr;
    if (file_ < 0) return;
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    ::close(std::exchange(file_, -1));
}

}  // namespace hogel::core
