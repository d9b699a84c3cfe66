// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "hogel/error.h"

namespace hogel::core {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': {}", path.string(), why));
}

std::string message(int error) { return std::generic_category().message(error); }

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& target, Unfinished unfinished)
    : target_(target), final_name_(target), unfinished_(unfinished) {
    static std::atomic<unsigned> count{0};
    if (target.filename().empty()) fail(target, "it has no file name");
    std::error_code status;
    if (std::filesystem::is_symlink(std::filesystem::symlink_status(target, status)))
        final_name_ = std::filesystem::weakly_canonical(target, status);
    const std::filesystem::file_status there = std::filesystem::status(final_name_, status);
    if (std::filesystem::is_directory(there)) fail(target, "it is a directory");
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
        fail(target, "it is not a plain file");
    const std::filesystem::path directory = final_name_.has_parent_path() ? final_name_.parent_path() : ".";
    if (!std::filesystem::is_directory(directory, status))
        fail(target, fmt::format("there is no directory '{}'", directory.string()));
    const std::string name = final_name_.filename().string();
    temporary_ = directory / (unfinished == Unfinished::kept ? fmt::format("{}.part", name)
                                                             : fmt::format(".{}.{}.{}.tmp", name, ::getpid(), count++));
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!committed_ && unfinished_ == Unfinished::removed) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::commit() {
    std::error_code error;
    std::filesystem::rename(temporary_, final_name_, error);
    if (error) fail(target_, error.message());
    committed_ = true;
}

void write_file(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    OutputFile file(path);
    const int out = ::open(file.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (out < 0) fail(path, message(errno));
    int error = 0;
    while (!bytes.empty() && error == 0) {
        const ssize_t written = ::write(out, bytes.data(), bytes.size());
        if (written > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        else if (errno != EINTR)
            error = errno;
    }
    if (::close(out) != 0 && error == 0) error = errno;
    if (error != 0) fail(path, message(error));
    file.commit();
}

}  // namespace hogel::core
