// SPDX-License-Identifier: Apache-2.0
// Film of a camera path past the scene: a frame is the view of a camera of one row, from the left. ffmpeg, if
// installed, decodes it into an unnamed temporary file of consecutive pixmaps.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "hogel/core/lower_case.h"
#include "hogel/core/output_file.h"
#include "hogel/core/program.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/exchange/view_set.h"
#include "hogel/image/formats/formats.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

// Rows of cameras are shorter; a longer film is rejected before decoding.
constexpr std::size_t max_frames = 1000;
// Maximum size of all decoded frames, bytes. A file of a few kilobytes can contain any number of frames.
constexpr std::uint64_t max_decoded = std::uint64_t{8} << 30;

bool probe(const fs::path& source) {
    const std::string ending = core::lower_case_extension(source);
    static const std::string endings[] = {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi", ".gif", ".apng"};
    std::error_code none;
    return std::ranges::count(endings, ending) > 0 && fs::is_regular_file(source, none);
}

class Decoder {
  public:
    Decoder(const fs::path& source, const fs::path& folder)
        : source_(source), folder_(folder), program_(core::find_program("ffmpeg")) {
        if (program_.empty())
            throw Error(ErrorCode::not_built_in,
                        fmt::format("{}: films are read by ffmpeg, which is not installed; a folder of its pictures, "
                                    "view_0001.png and so on, is read without",
                                    source.string()));
    }

    // Counts packets (= frames), up to `most`, without decoding.
    std::size_t count(std::size_t most) const {
        const auto list = run({"-an", "-sn", "-c", "copy", "-frames:v", fmt::format("{}", most), "-f", "framecrc"});
        std::string text(list->size(), ' ');
        list->read(0, text.data(), text.size());
        std::size_t packets = 0;  // one line each, after header lines that begin with '#'
        for (std::size_t line = 0; line < text.size(); line = std::min(text.find('\n', line), text.size()) + 1)
            packets += text[line] == '#' ? 0 : 1;
        return packets;
    }

    // Decodes to concatenated pixmaps (P6) of at most about `most` bytes.
    std::unique_ptr<core::RawFile> pixmaps(std::size_t frames, std::uint64_t most) const {
        return run({"-an", "-sn", "-vsync", "passthrough", "-frames:v", fmt::format("{}", frames), "-fs",
                    fmt::format("{}", most), "-f", "image2pipe", "-c:v", "ppm", "-pix_fmt", "rgb24"});
    }

  private:
    std::unique_ptr<core::RawFile> run(const std::vector<std::string>& output) const {
        const core::OutputFile made(folder_ / "hogel-film");  // its name is removed at the end of this function
        // The whitelist prevents playlists from reading other machines' files.
        std::vector<std::string> words{program_, "-nostdin", "-protocol_whitelist",
                                       "file",   "-i",       "file:" + fs::absolute(source_).string()};
        words.insert(words.end(), output.begin(), output.end());
        words.insert(words.end(), {"-y", "file:" + made.temporary().string()});
        const bool ran = core::run_program(words);
        auto file = std::make_unique<core::RawFile>(made.temporary(), core::RawFile::Mode::read, source_);
        if (!ran || file->size() == 0) fail_source(source_, "is no film that ffmpeg can read");
        return file;
    }

    const fs::path &source_, &folder_;
    std::string program_;
};

struct Frame {
    std::size_t width = 0, height = 0, bytes = 0;
};

Frame frame_of(const fs::path& source, const core::RawFile& file) {
    // "P6\nWIDTH HEIGHT\n255\n", the same for all frames.
    std::string start(std::min<std::uint64_t>(file.size(), 64), ' ');
    file.read(0, start.data(), start.size());
    std::size_t lines = 0, header = 0;
    while (header < start.size() && lines < 3) lines += start[header++] == '\n' ? 1 : 0;
    Frame frame;
    if (lines < 3 || std::sscanf(start.c_str(), "P6\n%zu %zu", &frame.width, &frame.height) != 2 || frame.width == 0 ||
        frame.height == 0 || frame.width > max_pixels / frame.height)
        fail_source(source, "is no film that ffmpeg can read");
    frame.bytes = header + 3 * frame.width * frame.height;
    return frame;
}

// Throws unless the frames of a film fit the limits and the free space of the folder.
void require_room(const fs::path& source, const fs::path& folder, const Frame& frame, std::size_t frames) {
    if (frames > max_frames)
        fail_source(source, fmt::format("has more than {} frames; a film of a row of cameras is shorter", max_frames));
    constexpr double gib = 1 << 30;
    const std::uint64_t bytes = frames * std::uint64_t{frame.bytes};
    const std::string size = fmt::format("its {} frames of {}x{} pixels take {:.3g} GiB decoded", frames, frame.width,
                                         frame.height, static_cast<double>(bytes) / gib);
    if (bytes > max_decoded)
        fail_source(source,
                    fmt::format("{}, more than {:.3g} GiB: a film of fewer or smaller frames, or a folder of its "
                                "pictures, would do",
                                size, static_cast<double>(max_decoded) / gib));
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    if (!error && bytes > space.available)
        throw Error(ErrorCode::cannot_write, fmt::format("{}: {}, but {} has {:.3g} GiB left", source.string(), size,
                                                         folder.string(), static_cast<double>(space.available) / gib));
}

class FilmPictures final : public ViewPictures {
  public:
    FilmPictures(const fs::path& source, const fs::path& folder) : source_(source) {
        const Decoder decoder(source, folder);
        const std::size_t packets = decoder.count(max_frames + 1);
        const Frame frame = frame_of(source, *decoder.pixmaps(1, max_decoded));
        require_room(source, folder, frame, packets);
        frame_bytes_ = frame.bytes;
        // One extra frame, because some packets hold several.
        file_ = decoder.pixmaps(max_frames + 1, (packets + 1) * std::uint64_t{frame.bytes});
        frames_ = static_cast<std::size_t>(file_->size() / frame_bytes_);
        require_room(source, folder, frame, frames_);
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

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    const auto pictures =
        std::make_shared<FilmPictures>(source, options.spool.empty() ? fs::temp_directory_path() : options.spool);
    ViewSet set;
    set.columns = pictures->frames();
    set.rows = 1;
    set.pictures = pictures;
    set.geometry.orthographic = options.orthographic.value_or(false);
    if (options.columns == 0) return set;
    if (options.columns * options.rows != set.columns)
        throw Error(ErrorCode::usage, "views",
                    fmt::format("{}: {}x{} views were asked for, but there are {}", source.string(), options.columns,
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
