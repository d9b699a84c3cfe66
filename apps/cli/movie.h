// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hogel/image.h"
#include "hogel/progress.h"

namespace hogel::cli {

/// Temporary folder for the frames of a film, in the folder of the film's file. The destructor removes it. A folder
/// left by a killed process is removed by the next process that writes the same file.
class FrameFolder {
  public:
    /// Throws Error(cannot_write).
    explicit FrameFolder(const std::filesystem::path& file);
    ~FrameFolder();
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int lock_ = -1;  // descriptor of the folder, holds the lock
};

/// Returns whether a name stands for several pictures: name####.png, numbered from 0, or a film.
bool is_movie(const std::filesystem::path& path);

/// Returns whether a name has the # of name####.png.
bool is_numbered(const std::filesystem::path& path);

/// Returns name0007.png for name####.png and frame 7.
std::filesystem::path numbered(const std::filesystem::path& path, std::size_t frame);

/// Throws Error(usage) unless is_movie(), Error(not_built_in) for a film if ffmpeg is not installed.
void require_movie(const std::filesystem::path& path);

/// Writes pictures as numbered files, or as a film encoded by ffmpeg. Returns the total size in bytes. Throws
/// Error(cannot_write).
std::uintmax_t write_movie(const std::filesystem::path& path, std::span<const Image> frames, double exposure,
                           double frames_a_second, const Metadata& metadata, const Progress& progress);

/// Encodes a film from pictures in the folder, the last step of write_movie(). Returns its size in bytes.
/// @param frames  pattern of the names: "%06d.png"
std::uintmax_t write_film(const std::filesystem::path& path, const FrameFolder& folder, const std::string& frames,
                          double frames_a_second, const Metadata& metadata, const Progress& progress);

}  // namespace hogel::cli
