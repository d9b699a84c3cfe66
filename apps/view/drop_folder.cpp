// SPDX-License-Identifier: Apache-2.0
#include "view/drop_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <utility>

#include "hogel/error.h"

namespace hogel::view {
namespace {

constexpr std::size_t max_name = 120;

void remove(std::filesystem::path& folder) {
    std::error_code none;
    if (!folder.empty()) std::filesystem::remove_all(folder, none);
    folder.clear();
}

}  // namespace

DropFolder::~DropFolder() {
    remove(earlier_);
    remove(open_);
    remove(coming_);
}

std::filesystem::path DropFolder::destination_for(const std::string& name) {
    const bool plain = !name.empty() && name.size() <= max_name && name.front() != '.' && name.front() != '-' &&
                       name.find('/') == std::string::npos && name.find('\0') == std::string::npos;
    if (!plain) throw Error(ErrorCode::usage, fmt::format("name: '{}' is not a plain file name", name.substr(0, 40)));
    if (coming_.empty()) {
        std::string folder = (std::filesystem::temp_directory_path() / "hogel-view-XXXXXX").string();
        if (mkdtemp(folder.data()) == nullptr)
            throw Error(ErrorCode::cannot_write, folder + ": cannot be made; the folder of TMPDIR must be writable");
        coming_ = folder;
    }
    return coming_ / name;
}

void DropFolder::opened() {
    if (earlier_.empty())
        earlier_ = std::exchange(open_, {});
    else
        remove(open_);  // was never shown
    open_ = std::exchange(coming_, {});
}

void DropFolder::forget_earlier() { remove(earlier_); }

}  // namespace hogel::view
