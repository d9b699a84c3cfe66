// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace hogel::view {

/// A static file of the page, from apps/view/web, embedded as an array by embed.cmake.
struct PageFile {
    std::string_view path;  ///< URL path: "/view.js"
    std::string_view type;  ///< media type: "text/javascript; charset=utf-8"
    std::string_view bytes;
};

/// Returns all files of the page. Together with the paths in viewer.cpp they are all URLs; no file system is read.
std::span<const PageFile> page_files();

}  // namespace hogel::view
