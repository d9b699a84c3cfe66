// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace hogel::view {

/// A file of the page, apps/view/web, which the build turns into an array (embed.cmake).
struct PageFile {
    std::string_view path;  ///< of its address: "/view.js"
    std::string_view type;  ///< "text/javascript; charset=utf-8"
    std::string_view bytes;
};

/// All files of the page. These are all addresses that there are besides those of viewer.cpp; no file system is read.
std::span<const PageFile> page_files();

}  // namespace hogel::view
