#include "outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

#include "hogel/core/error.h"

namespace hogel::cli {
namespace fs = std::filesystem;

void require_writable(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!fs::is_directory(folder))
        throw Error(ErrorCode::cannot_write, fmt::format("{}: there is no folder {}", file.string(), folder.string()));
    if (fs::is_directory(file)) throw Error(ErrorCode::cannot_write, fmt::format("{}: is a folder", file.string()));
    if (access(folder.c_str(), W_OK) != 0)
        throw Error(ErrorCode::cannot_write,
                    fmt::format("{}: the folder {} is not writable", file.string(), folder.string()));
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

void write_file(const fs::path& path, std::string_view contents) {
    fs::path temporary = path;
    temporary += fmt::format(".{}.tmp", getpid());
    std::ofstream file(temporary, std::ios::binary);
    file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    file.close();
    std::error_code error;
    if (file) fs::rename(temporary, path, error);
    if (!file || error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw Error(ErrorCode::cannot_write, fmt::format("{}: cannot write it", path.string()));
    }
}

}  // namespace hogel::cli
