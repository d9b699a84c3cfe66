// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "hogel/image.h"
#include "hogel/progress.h"

namespace hogel::cli {

/// A temporary folder beside a file, for the frames of a film. Removed with the object; that of a process that was
/// killed is removed by the next one for the same file.
class FrameFolder {
  public:
    /// Throws Error(cannot_write).
    explicit FrameFolder(const std::filesystem::path& beside);
    ~FrameFolder();
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int lock_ = -1;  // a descriptor of the folder that holds the lock
};

/// Whether a name is that of several pictures: name####.png, numbered from 0, or a film.
bool is_movie(const std::filesystem::path& path);

/// Throws Error(usage) for a name that is_movie() refuses, Error(not_built_in) for a movie file if ffmpeg is not
/// installed.
void require_movie(const std::filesystem::path& path);

/// Writes pictures as numbered files, or as a movie made by ffmpeg, and returns their size in bytes. Throws
/// Error(cannot_write).
std::uintmax_t write_movie(const std::filesystem::path& path, std::span<const Image> frames, double exposure,
                           double frames_a_second, const Metadata& metadata, const Progress& progress);

/// The last step of write_movie() for a film: makes it of pictures in the folder with names such as "%06d.png", and
/// returns its size in bytes.
std::uintmax_t write_film(const std::filesystem::path& path, const FrameFolder& folder, const std::string& frames,
                          double frames_a_second, const Metadata& metadata, const Progress& progress);

}  // namespace hogel::cli
