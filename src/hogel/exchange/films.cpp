// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange.h"

#include <fmt/format.h>

#include <vector>

#include "hogel/core/output_file.h"
#include "hogel/core/program.h"
#include "hogel/core/stop_scope.h"
#include "hogel/error.h"

namespace hogel {
namespace fs = std::filesystem;

bool can_make_films() { return !core::find_program("ffmpeg").empty(); }

bool is_film(const fs::path& path) {
    const std::string kind = path.extension().string();
    return path.filename().string().find('#') == std::string::npos &&
           (kind == ".mp4" || kind == ".gif" || kind == ".apng");
}

void make_film(const fs::path& path, const fs::path& folder, const std::string& frames, double frames_a_second,
               const std::string& comment, const Progress& progress) {
    const core::StopScope scope(progress);
    const std::string program = core::find_program("ffmpeg");
    if (program.empty())
        throw Error(ErrorCode::not_built_in,
                    fmt::format("{}: films are made by ffmpeg, which is not installed", path.string()));
    core::OutputFile film(path);
    const std::string kind = path.extension().string();
    std::vector<std::string> words{
        program, "-y", "-framerate", fmt::format("{}", frames_a_second), "-i", (folder / frames).string()};
    const auto add = [&](std::initializer_list<const char*> more) {
        words.insert(words.end(), more.begin(), more.end());
    };
    if (kind == ".mp4")
        add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"});
    else if (kind == ".gif")
        add({"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0", "-f", "gif"});
    else
        add({"-plays", "0", "-f", "apng"});
    if (!comment.empty()) words.insert(words.end(), {"-metadata", "comment=" + comment});
    words.push_back("file:" + film.temporary().string());
    if (!core::run_program(words))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: ffmpeg failed to make it", path.string()));
    film.commit();
}

}  // namespace hogel
