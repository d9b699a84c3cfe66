// SPDX-License-Identifier: Apache-2.0
// A film of a walk past the scene: each frame is what a camera of one row sees, from the left. The program ffmpeg,
// where it is installed, decodes it into a temporary file of pixmaps one after the other, which has no name once it is
// complete.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "hogel/core/output_file.h"
#include "hogel/core/program.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/exchange/view_set.h"
#include "hogel/image/formats/formats.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

// A row of cameras is shorter; a longer film is refused before it fills a disk.
constexpr std::size_t max_frames = 1000;

bool probe(const fs::path& source) {
    std::string ending = source.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    static const std::string endings[] = {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi", ".gif", ".apng"};
    std::error_code none;
    return std::ranges::count(endings, ending) > 0 && fs::is_regular_file(source, none);
}

// Decodes a film into pixmaps (P6) of the same size.
std::unique_ptr<core::RawFile> decoded(const fs::path& source, const fs::path& folder) {
    const std::string program = core::find_program("ffmpeg");
    if (program.empty())
        throw Error(ErrorCode::not_built_in,
                    fmt::format("{}: films are read by ffmpeg, which is not installed; a folder of its pictures, "
                                "view_0001.png and so on, is read without",
                                source.string()));
    const core::OutputFile frames(folder / "hogel-film");  // takes the name away again at the end of this function
    // A file that names others, as playlists do, cannot make it read them from elsewhere than this machine.
    const bool ran = core::run_program({program, "-nostdin", "-protocol_whitelist", "file", "-i",
                                        "file:" + fs::absolute(source).string(), "-an", "-vsync", "passthrough",
                                        "-frames:v", fmt::format("{}", max_frames + 1), "-f", "image2pipe", "-c:v",
                                        "ppm", "-pix_fmt", "rgb24", "-y", "file:" + frames.temporary().string()});
    auto file = std::make_unique<core::RawFile>(frames.temporary(), core::RawFile::Mode::read, source);
    if (!ran || file->size() == 0) fail_source(source, "is no film that ffmpeg can read");
    return file;
}

class FilmPictures final : public ViewPictures {
  public:
    FilmPictures(const fs::path& source, const fs::path& folder) : source_(source), file_(decoded(source, folder)) {
        // "P6\nWIDTH HEIGHT\n255\n", the same for all frames.
        std::string start(std::min<std::uint64_t>(file_->size(), 64), ' ');
        file_->read(0, start.data(), start.size());
        std::size_t lines = 0, header = 0;
        while (header < start.size() && lines < 3) lines += start[header++] == '\n' ? 1 : 0;
        std::size_t width = 0, height = 0;
        if (lines < 3 || std::sscanf(start.c_str(), "P6\n%zu %zu", &width, &height) != 2 || width == 0 || height == 0 ||
            width > max_pixels / height)
            fail_source(source, "is no film that ffmpeg can read");
        frame_bytes_ = header + 3 * width * height;
        frames_ = static_cast<std::size_t>(file_->size() / frame_bytes_);
        if (frames_ > max_frames)
            fail_source(source,
                        fmt::format("has more than {} frames; a film of a row of cameras is shorter", max_frames));
        if (frames_ * frame_bytes_ != file_->size()) fail_source(source, "its frames differ in size");
    }
    std::size_t frames() const { return frames_; }

    image::Picture read(std::size_t, std::size_t frame) const override {
        std::vector<unsigned char> bytes(frame_bytes_);
        file_->read(frame * frame_bytes_, bytes.data(), bytes.size());
        return image::read_pnm({bytes, name(0, frame), max_pixels});
    }
    std::string name(std::size_t, std::size_t frame) const override {
        return fmt::format("{}, frame {}", source_.string(), frame);
    }

  private:
    fs::path source_;
    std::unique_ptr<core::RawFile> file_;
    std::size_t frame_bytes_ = 0, frames_ = 0;
};

ViewSet open(const fs::path& source, const ViewOptions& options) {
    const auto pictures =
        std::make_shared<FilmPictures>(source, options.spool.empty() ? fs::temp_directory_path() : options.spool);
    ViewSet set;
    set.columns = pictures->frames();
    set.rows = 1;
    set.pictures = pictures;
    set.geometry.orthographic = options.orthographic.value_or(false);
    if (options.columns == 0) return set;
    if (options.columns * options.rows != set.columns)
        throw Error(ErrorCode::usage, fmt::format("{}x{} views were asked for, but there are {}", options.columns,
                                                  options.rows, set.columns));
    return reordered(std::move(set), options.rows, options.columns, [=](std::size_t row, std::size_t column) {
        return std::pair(std::size_t{0}, row * options.columns + column);
    });
}

}  // namespace

ViewLayout film_layout() {
    return {.name = "film",
            .text = "a film of a row of cameras from the left: .mp4, .gif, .apng and others, by the program ffmpeg",
            .is_folder = false,
            .cameras_only = false,
            .probe = probe,
            .open = open};
}

}  // namespace hogel::exchange
