// SPDX-License-Identifier: Apache-2.0
#include "movie.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "hogel/error.h"
#include "hogel/exchange.h"
#include "hogel/pipeline.h"
#include "hogel/progress.h"

namespace hogel::cli {
namespace fs = std::filesystem;
namespace {

// Returns the id of the process that created a temporary folder of frames, or 0 for other names.
pid_t owner_pid(const std::string& name, const std::string& prefix) {
    int pid = 0, parsed = 0;
    const bool matches = name.starts_with(prefix) &&
                         std::sscanf(name.c_str() + prefix.size(), "%d.tmp%n", &pid, &parsed) == 1 &&
                         prefix.size() + static_cast<std::size_t>(parsed) == name.size();
    return matches ? pid : 0;
}

// Opens a folder and locks it. Returns its descriptor, or -1 if another process holds the lock.
int open_locked(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
    ::close(descriptor);
    return -1;
}

// Removes the folders of killed processes for the same film.
void remove_stale_folders(const fs::path& parent, const std::string& prefix) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(parent, ignored)) {
        const pid_t owner = owner_pid(entry.path().filename().string(), prefix);
        if (owner <= 0 || ::kill(owner, 0) == 0 || errno != ESRCH) continue;
        // A process on another machine may share the folder and hold the lock.
        const int descriptor = open_locked(entry.path());
        if (descriptor < 0) continue;
        fs::remove_all(entry.path(), ignored);
        ::close(descriptor);
    }
}

// Moves a frame to its final path, following a symbolic link. Returns its size in bytes.
std::uintmax_t move_frame(const FrameFolder& folder, const fs::path& frame) {
    std::error_code error;
    const fs::path name = fs::is_symlink(frame, error) ? fs::weakly_canonical(frame, error) : frame;
    fs::rename(folder.path() / frame.filename(), name, error);
    if (error)
        throw Error(ErrorCode::cannot_write, fmt::format("cannot write '{}': {}", frame.string(), error.message()));
    return fs::file_size(name);
}

}  // namespace

FrameFolder::FrameFolder(const fs::path& file) {
    const fs::path parent = fs::absolute(file).parent_path();
    const std::string prefix = fmt::format(".{}.", file.filename().string());
    remove_stale_folders(parent, prefix);
    path_ = parent / fmt::format("{}{}.tmp", prefix, getpid());
    std::error_code error;
    if (!fs::create_directory(path_, error))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: cannot create this folder", path_.string()));
    lock_ = open_locked(path_);
}

FrameFolder::~FrameFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

bool is_numbered(const fs::path& path) { return path.filename().string().find('#') != std::string::npos; }

fs::path numbered(const fs::path& path, std::size_t frame) {
    std::string name = path.filename().string();
    const std::size_t first = name.find('#'), end = name.find_first_not_of('#', first);
    name.replace(first, end - first, fmt::format("{:0{}}", frame, end - first));
    return path.parent_path() / name;
}

bool is_movie(const fs::path& path) { return is_numbered(path) || is_film(path); }

void require_movie(const fs::path& path) {
    if (!is_movie(path))
        throw Error(ErrorCode::usage,
                    fmt::format("{}: expected .mp4, .gif, .apng or name####.png for several pictures", path.string()));
    if (is_numbered(path))
        require_picture_name(path);
    else if (!can_make_films())
        throw Error(ErrorCode::not_built_in,
                    fmt::format("{}: films need ffmpeg, which is not installed; use name####.png to write pictures",
                                path.string()));
}

std::uintmax_t write_movie(const fs::path& path, std::span<const Image> frames, double exposure, double frames_a_second,
                           const Metadata& metadata, const Progress& progress) {
    const Stoppable stoppable(progress);
    const FrameFolder folder(path);
    if (is_numbered(path)) {
        for (std::size_t i = 0; i < frames.size(); ++i) require_writable(numbered(path, i));
        for (std::size_t i = 0; i < frames.size(); ++i)
            write_image(folder.path() / numbered(path.filename(), i), frames[i], exposure, metadata);
        std::uintmax_t bytes = 0;
        for (std::size_t i = 0; i < frames.size(); ++i) bytes += move_frame(folder, numbered(path, i));
        return bytes;
    }
    for (std::size_t i = 0; i < frames.size(); ++i)
        write_image(folder.path() / fmt::format("{:06}.png", i), frames[i], exposure);
    return write_film(path, folder, "%06d.png", frames_a_second, metadata, progress);
}

std::uintmax_t write_film(const fs::path& path, const FrameFolder& folder, const std::string& frames,
                          double frames_a_second, const Metadata& metadata, const Progress& progress) {
    std::string comment;
    for (const auto& [key, value] : metadata)
        if (key == "software") comment = value;
    make_film(path, folder.path(), frames, frames_a_second, comment, progress);
    return fs::file_size(path);
}

}  // namespace hogel::cli
