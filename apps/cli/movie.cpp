// SPDX-License-Identifier: Apache-2.0
#include "movie.h"

#include <fmt/format.h>
#include <unistd.h>

#include "hogel/error.h"
#include "hogel/films.h"

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
    else if (!can_make_films())
        throw Error(ErrorCode::not_built_in,
                    fmt::format("{}: films are made by ffmpeg, which is not installed; name####.png writes pictures",
                                path.string()));
}

std::uintmax_t write_movie(const fs::path& path, std::span<const Image> frames, double exposure, double frames_a_second,
                           const Metadata& metadata, const Progress& progress) {
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
