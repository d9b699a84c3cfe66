// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel::core {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': {}", path.string(), why));
}

std::string message(int error) { return std::generic_category().message(error); }

// Locks one byte far beyond the end of a file, where no other lock is, until the descriptor is closed. Returns success.
bool lock(int descriptor) {
    struct flock range {};
    range.l_type = F_WRLCK;
    range.l_whence = SEEK_SET;
    range.l_start = std::numeric_limits<off_t>::max() - 1;
    range.l_len = 1;
    return ::fcntl(descriptor, F_OFD_SETLK, &range) == 0;
}

// Opens and locks an existing temporary file or folder. Returns -1 if another process holds the lock.
int open_locked(const std::filesystem::path& temporary) {
    std::error_code ignored;
    const bool is_folder = std::filesystem::is_directory(std::filesystem::symlink_status(temporary, ignored));
    const int descriptor =
        ::open(temporary.c_str(), (is_folder ? O_RDONLY | O_DIRECTORY : O_RDWR) | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0) return -1;
    if (is_folder ? ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 : lock(descriptor)) return descriptor;
    ::close(descriptor);
    return -1;
}

// Removes temporaries of this file or set that killed processes left behind.
void remove_stale_temporaries(const std::filesystem::path& directory, const std::string& name) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
        const std::string file = entry.path().filename().string();
        int pid = 0, parsed = 0;
        unsigned number = 0;
        const std::string prefix = fmt::format(".{}.", name);
        if (!file.starts_with(prefix) ||
            std::sscanf(file.c_str() + prefix.size(), "%d.%u.tmp%n", &pid, &number, &parsed) != 2 ||
            static_cast<std::size_t>(parsed) != file.size() - prefix.size() || pid <= 0)
            continue;
        if (::kill(pid, 0) == 0 || errno != ESRCH) continue;
        // A process on another machine that shares the folder may hold the lock.
        const int descriptor = open_locked(entry.path());
        if (descriptor < 0) continue;
        std::filesystem::remove_all(entry.path(), ignored);
        ::close(descriptor);
    }
}

std::string temporary_name(const std::string& name) {
    static std::atomic<unsigned> count{0};
    return fmt::format(".{}.{}.{}.tmp", name, ::getpid(), count++);
}

std::filesystem::path directory_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : ".";
}

// Returns the file of a target, with symbolic links followed. Throws if it or its directory has the wrong type.
std::filesystem::path final_name_of(const std::filesystem::path& target) {
    if (target.filename().empty()) fail(target, "it has no file name");
    std::error_code status;
    const bool link = std::filesystem::is_symlink(std::filesystem::symlink_status(target, status));
    std::filesystem::path file = link ? std::filesystem::weakly_canonical(target, status) : target;
    const std::filesystem::file_status file_status = std::filesystem::status(file, status);
    if (std::filesystem::is_directory(file_status)) fail(target, "it is a directory");
    if (std::filesystem::exists(file_status) && !std::filesystem::is_regular_file(file_status))
        fail(target, "it is not a plain file");
    const std::filesystem::path directory = directory_of(file);
    if (!std::filesystem::is_directory(directory, status))
        fail(target, fmt::format("there is no directory '{}'", directory.string()));
    return file;
}

}  // namespace

void require_target(const std::filesystem::path& target) {
    if (::access(directory_of(final_name_of(target)).c_str(), W_OK) != 0) fail(target, "its directory is not writable");
}

std::filesystem::path folder_of(const std::filesystem::path& target) { return directory_of(final_name_of(target)); }

OutputFile::OutputFile(const std::filesystem::path& target, Unfinished unfinished)
    : target_(target), final_name_(final_name_of(target)), unfinished_(unfinished) {
    const std::filesystem::path directory = directory_of(final_name_);
    const std::string name = final_name_.filename().string();
    if (unfinished == Unfinished::kept) {
        temporary_ = directory / fmt::format("{}.part", name);
        return;
    }
    remove_stale_temporaries(directory, name);
    temporary_ = directory / temporary_name(name);
    lock_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (lock_ < 0) fail(target, message(errno));
    lock(lock_);  // without locks of the file system, only the process number identifies the owner
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!committed_ && unfinished_ == Unfinished::removed) std::filesystem::remove(temporary_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

void OutputFile::commit() {
    std::error_code error;
    std::filesystem::rename(temporary_, final_name_, error);
    if (error) fail(target_, error.message());
    committed_ = true;
}

void write_file(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
    constexpr std::size_t bytes_between_checks = std::size_t{16} << 20;
    OutputFile file(path);
    RawFile out(file.temporary(), RawFile::Mode::create, path);
    for (std::size_t offset = 0; offset < bytes.size(); offset += bytes_between_checks) {
        throw_if_stopped();
        out.write(offset, bytes.data() + offset, std::min(bytes_between_checks, bytes.size() - offset));
    }
    out.close();
    file.commit();
}

namespace {

// Temporary folder of a set of files.
class SetFolder {
  public:
    explicit SetFolder(const std::filesystem::path& folder) : folder_(folder) {
        constexpr const char* name = "hogel-set";
        remove_stale_temporaries(folder, name);
        path_ = folder / temporary_name(name);
        std::error_code error;
        std::filesystem::create_directory(path_, error);
        if (error) fail(folder, error.message());
        lock_ = open_locked(path_);
    }
    ~SetFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
        if (lock_ >= 0) ::close(lock_);
    }
    SetFolder(const SetFolder&) = delete;
    SetFolder& operator=(const SetFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // Moves all files into the folder. Checks all destinations before the first move.
    void commit() {
        std::vector<std::pair<std::filesystem::path, std::filesystem::path>> moves;
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator(path_, error))
            moves.emplace_back(entry.path(), final_name_of(folder_ / entry.path().filename()));
        if (error) fail(folder_, error.message());
        for (const auto& [from, to] : moves) move(from, to);
    }

    // Returns an error message with the final instead of the temporary path of files.
    std::string message_of(const Error& error) const {
        std::string text = error.what();
        const std::string temporary = path_.string(), final_path = folder_.string();
        for (std::size_t position = 0; (position = text.find(temporary, position)) != std::string::npos;
             position += final_path.size())
            text.replace(position, temporary.size(), final_path);
        return text;
    }

  private:
    void move(const std::filesystem::path& from, const std::filesystem::path& to) {
        std::error_code error;
        std::filesystem::rename(from, to, error);
        if (error != std::errc::cross_device_link) {
            if (error) fail(to, error.message());
            return;
        }
        OutputFile copy(to);  // the destination is a link to another file system
        std::filesystem::copy_file(from, copy.temporary(), std::filesystem::copy_options::overwrite_existing, error);
        if (error) fail(to, error.message());
        copy.commit();
    }

    std::filesystem::path folder_, path_;
    int lock_ = -1;  // descriptor of the folder; holds the lock
};

}  // namespace

void write_set(const std::filesystem::path& folder, const std::function<void(const std::filesystem::path&)>& write) {
    SetFolder set(folder);
    try {
        write(set.path());
        set.commit();
    } catch (const Error& error) {
        throw Error(error.code(), set.message_of(error));
    }
}

}  // namespace hogel::core
