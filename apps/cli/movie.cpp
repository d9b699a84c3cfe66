// SPDX-License-Identifier: Apache-2.0
#include "movie.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "hogel/error.h"

namespace hogel::cli {
namespace fs = std::filesystem;
namespace {

std::string numbered(const fs::path& path, std::size_t frame) {
    std::string name = path.filename().string();
    const std::size_t first = name.find('#'), end = name.find_first_not_of('#', first);
    name.replace(first, end - first, fmt::format("{:0{}}", frame, end - first));
    return (path.parent_path() / name).string();
}

bool is_numbered(const fs::path& path) { return path.filename().string().find('#') != std::string::npos; }

// The path of ffmpeg, or an empty text.
std::string ffmpeg() {
    const char* places = std::getenv("PATH");
    std::istringstream folders(places != nullptr ? places : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path program = fs::path(folder) / "ffmpeg";
        if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program.string();
    }
    return "";
}

// Runs a program and waits for it. Returns false if it fails.
bool run(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (int stream : {0, 1, 2}) posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    // The program would inherit the blocked signals and could not be stopped.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    pid_t child = 0;
    const int started = posix_spawn(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (started != 0 || waitpid(child, &status, 0) != child) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

FrameFolder::FrameFolder(const fs::path& beside)
    : path_(fs::absolute(beside).parent_path() / fmt::format(".{}.{}.tmp", beside.filename().string(), getpid())) {
    std::error_code error;
    if (!fs::create_directory(path_, error))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: cannot create this folder", path_.string()));
}

FrameFolder::~FrameFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

bool is_film(const fs::path& path) {
    const std::string kind = path.extension().string();
    return !is_numbered(path) && (kind == ".mp4" || kind == ".gif" || kind == ".apng");
}

bool is_movie(const fs::path& path) { return is_numbered(path) || is_film(path); }

void require_movie(const fs::path& path) {
    if (!is_movie(path))
        throw Error(
            ErrorCode::usage,
            fmt::format("{}: several pictures are written as .mp4, .gif, .apng or name####.png", path.string()));
    if (is_numbered(path))
        require_picture_name(path);
    else if (ffmpeg().empty())
        throw Error(ErrorCode::not_built_in,
                    fmt::format("{}: films are made by ffmpeg, which is not installed; name####.png writes pictures",
                                path.string()));
}

std::uintmax_t write_movie(const fs::path& path, std::span<const Image> frames, double exposure, double frames_a_second,
                           const Metadata& metadata) {
    if (is_numbered(path)) {
        std::uintmax_t bytes = 0;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            write_image(numbered(path, i), frames[i], exposure, metadata);
            bytes += fs::file_size(numbered(path, i));
        }
        return bytes;
    }
    const FrameFolder folder(path);
    for (std::size_t i = 0; i < frames.size(); ++i)
        write_image(folder.path() / fmt::format("{:06}.png", i), frames[i], exposure);
    return make_film(path, folder, "%06d.png", frames_a_second, metadata);
}

std::uintmax_t make_film(const fs::path& path, const FrameFolder& folder, const std::string& frames,
                         double frames_a_second, const Metadata& metadata) {
    const std::string kind = path.extension().string(), film = (folder.path() / ("film" + kind)).string();
    std::vector<std::string> words{
        ffmpeg(), "-y", "-framerate", fmt::format("{}", frames_a_second), "-i", (folder.path() / frames).string()};
    const auto add = [&](std::initializer_list<const char*> more) {
        words.insert(words.end(), more.begin(), more.end());
    };
    if (kind == ".mp4")
        add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
    else if (kind == ".gif")
        add({"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"});
    else
        add({"-plays", "0", "-f", "apng"});
    for (const auto& [key, value] : metadata)
        if (key == "software") words.insert(words.end(), {"-metadata", "comment=" + value});
    words.push_back(film);
    if (!run(words)) throw Error(ErrorCode::cannot_write, fmt::format("{}: ffmpeg failed to make it", path.string()));
    std::error_code error;
    fs::rename(film, path, error);
    if (error) throw Error(ErrorCode::cannot_write, fmt::format("{}: {}", path.string(), error.message()));
    return fs::file_size(path);
}

std::size_t extract_frames(const fs::path& film, const FrameFolder& folder) {
    if (ffmpeg().empty())
        throw Error(ErrorCode::not_built_in,
                    fmt::format("{}: films are read by ffmpeg, which is not installed; a folder of its pictures, "
                                "view_0001.png and so on, is read without",
                                film.string()));
    if (!fs::is_regular_file(film)) throw Error(ErrorCode::bad_input, fmt::format("{}: no such file", film.string()));
    // A file that names others, as playlists do, cannot make it read them from elsewhere than this machine.
    const std::vector<std::string> words{ffmpeg(), "-nostdin",    "-protocol_whitelist",
                                         "file",   "-i",          fs::absolute(film).string(),
                                         "-vsync", "passthrough", (folder.path() / "view_%06d.png").string()};
    const bool ran = run(words);
    const auto frames =
        static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
    if (!ran || frames == 0)
        throw Error(ErrorCode::bad_input, fmt::format("{}: is no film that ffmpeg can read", film.string()));
    return frames;
}

}  // namespace hogel::cli
