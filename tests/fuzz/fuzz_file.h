// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "hogel/error.h"

namespace hogel::fuzz {

/// A file with the bytes of one execution of a fuzz target, removed afterwards.
class FuzzFile {
  public:
    FuzzFile(const std::uint8_t* data, std::size_t size, const std::string& extension)
        : path_(std::filesystem::temp_directory_path() / ("hogel_fuzz_" + std::to_string(::getpid()) + extension)) {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    ~FuzzFile() { std::filesystem::remove(path_); }
    FuzzFile(const FuzzFile&) = delete;
    FuzzFile& operator=(const FuzzFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Whatever is wrong with a file is bad_input, or not_built_in for an optional format; anything else is a finding.
template <class Work>
void expect_bad_input(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input && error.code() != ErrorCode::usage &&
            error.code() != ErrorCode::not_built_in)
            throw;
    }
}

}  // namespace hogel::fuzz
