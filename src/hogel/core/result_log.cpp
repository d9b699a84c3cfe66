// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/result_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "hogel/core/checksum.h"
#include "hogel/core/shared_order.h"
#include "hogel/error.h"
#include "hogel/resume.h"
#include "hogel/team.h"

namespace hogel::core {
namespace {

constexpr std::string_view first_line = "hogel results 1\n", last_line = "results\n";

std::atomic<ResultLog*> current = nullptr;

std::uint32_t checksum_of(std::string_view head, std::string_view bytes) {
    const auto octets = [](std::string_view text) {
        return std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    };
    // That of the bytes goes into that of both.
    std::string both(head);
    const std::uint32_t sum = checksum(octets(bytes));
    both.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return checksum(octets(both));
}

}  // namespace

ResultLog* result_log() { return current; }

void set_result_log(ResultLog* log) { current = log; }

ResultLog::ResultLog(const std::filesystem::path& path, const std::vector<std::string>& work)
    : path_(path), at_end_(path.empty()) {
    if (path.empty()) return;
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) fail(errno);
    try {
        if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': another process is", path_.string()));
        read_work(work);
    } catch (...) {
        ::close(file_);
        throw;
    }
}

ResultLog::~ResultLog() {
    if (file_ < 0) return;
    if (results_ == 0)
        remove();
    else
        ::close(file_);
}

void ResultLog::fail(int error) const {
    throw Error(ErrorCode::cannot_write,
                fmt::format("cannot write '{}': {}", path_.string(), std::generic_category().message(error)));
}

void ResultLog::read_work(const std::vector<std::string>& work) {
    std::string lines(first_line);
    for (std::string line : work) {
        std::ranges::replace(line, '\n', ' ');
        lines += fmt::format("work {}\n", line);
    }
    lines += last_line;
    struct stat status {};
    if (::fstat(file_, &status) != 0) fail(errno);
    if (status.st_size == 0) {
        write(lines);
        at_end_ = true;
        return;
    }
    constexpr std::size_t longest = 1 << 20;
    std::string start(std::min<std::size_t>(longest, static_cast<std::size_t>(status.st_size)), '\0');
    if (!read(start.data(), start.size()) || !start.starts_with(first_line))
        throw Error(ErrorCode::bad_input,
                    fmt::format("cannot resume '{}': it does not hold results of hogel; remove it "
                                "to begin again",
                                path_.string()));
    std::istringstream has(start), needs(lines);
    for (std::string was, is; std::getline(needs, is);) {
        if (!std::getline(has, was)) was.clear();
        if (was == is) continue;
        const auto of_work = [](const std::string& line) { return line.starts_with("work ") ? line.substr(5) : ""; };
        throw Error(ErrorCode::usage, fmt::format("cannot resume '{}': it was begun with '{}', not '{}'; remove it to "
                                                  "begin again",
                                                  path_.string(), of_work(was), of_work(is)));
    }
    if (::lseek(file_, static_cast<off_t>(lines.size()), SEEK_SET) < 0) fail(errno);
    place_ = lines.size();
}

bool ResultLog::read(void* to, std::size_t bytes) {
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

bool ResultLog::read_record(Head& head, std::string& bytes) {
    std::uint64_t sum = 0;
    if (!read(&sum, sizeof sum) || !read(&head, sizeof head)) return false;
    struct stat status {};
    if (::fstat(file_, &status) != 0) fail(errno);
    if (head.bytes > static_cast<std::uint64_t>(status.st_size)) return false;
    bytes.resize(head.bytes);
    if (!read(bytes.data(), bytes.size())) return false;
    return sum == checksum_of({reinterpret_cast<const char*>(&head), sizeof head}, bytes);
}

void ResultLog::write(std::string_view bytes) {
    for (std::string_view rest = bytes; !rest.empty();) {
        const ssize_t put = ::write(file_, rest.data(), rest.size());
        if (put > 0)
            rest.remove_prefix(static_cast<std::size_t>(put));
        else if (errno != EINTR)
            fail(errno);
    }
    place_ += bytes.size();
}

// What follows the last record that was taken is not of this work.
void ResultLog::forget_the_rest() {
    if (at_end_) return;
    if (::ftruncate(file_, static_cast<off_t>(place_)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) fail(errno);
    at_end_ = true;
}

std::size_t ResultLog::begin(std::size_t n, const std::function<void(std::size_t i, std::string_view bytes)>& take) {
    next_ = {loops_++, n, 0, 0};
    while (!at_end_ && next_.result < n) {
        Head head;
        std::string bytes;
        if (!read_record(head, bytes) || head.loop != next_.loop || head.results != n || head.result != next_.result) {
            forget_the_rest();
            break;
        }
        take(next_.result++, bytes);
        ++results_;
        place_ += sizeof(std::uint64_t) + sizeof head + bytes.size();
    }
    return next_.result;
}

void ResultLog::keep(std::string_view bytes) {
    if (file_ < 0) return;
    forget_the_rest();
    next_.bytes = bytes.size();
    const std::string_view head(reinterpret_cast<const char*>(&next_), sizeof next_);
    const std::uint64_t sum = checksum_of(head, bytes);
    std::string record(reinterpret_cast<const char*>(&sum), sizeof sum);
    record += head;
    record += bytes;
    write(record);
    ++next_.result;
    ++results_;
}

void ResultLog::remove() {
    if (file_ < 0) return;
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    ::close(std::exchange(file_, -1));
}

}  // namespace hogel::core

namespace hogel {

ResumeScope::ResumeScope(const std::filesystem::path& file, const std::vector<std::string>& work)
    : log_(std::make_unique<core::ResultLog>(is_first_process() ? file : std::filesystem::path(), work)) {
    if (core::result_log() != nullptr) throw Error(ErrorCode::usage, "only one work at a time can be resumed");
    core::set_result_log(log_.get());
}

ResumeScope::~ResumeScope() { core::set_result_log(nullptr); }

void ResumeScope::once(const std::function<void()>& work) {
    core::kept_one_by_one<std::uint8_t>(
        1, {},
        [&](std::size_t) {
            work();
            return std::uint8_t{1};
        },
        [](std::size_t, std::uint8_t&) {});
}

void ResumeScope::complete() { log_->remove(); }

}  // namespace hogel
