// SPDX-License-Identifier: Apache-2.0
#include "outputs.h"

#include <fmt/format.h>
#include "hogel/error.h"
#include "hogel/units.h"

namespace hogel::cli {
namespace fs = std::filesystem;

void add_resume_flag(CLI::App* command, bool& resume) {
    command->add_flag("--resume", resume,
                      "Keep what is done when interrupted, as FILE.part, and go on from there the next time");
}

void say_what_was_compressed(const Session& session, const std::string& file, const CompressionResult& result) {
    session.say(fmt::format("{}: {}, {:.2f} dB, {:.4g} pixels per bit, coded {} {}", file,
                            format_bytes(static_cast<double>(result.bytes)), result.sqnr, result.pixels_per_bit,
                            result.passes, result.passes == 1 ? "time" : "times"));
    if (result.depth_bytes > 0)
        session.say(fmt::format("of which depth: {}, to within {:.3g} m",
                                format_bytes(static_cast<double>(result.depth_bytes)), result.depth_error));
}

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    created_ = fs::create_directories(path_, error);
    if (error || !fs::is_directory(path_))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: cannot create this folder: {}", path_.string(),
                                                         error ? error.message() : "a file has its name"));
    require_writable(path_ / "report.html");
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    if (created_) fs::remove(path_, ignored);  // succeeds for an empty folder alone
}

}  // namespace hogel::cli
