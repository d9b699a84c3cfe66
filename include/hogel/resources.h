// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

namespace hogel {

/// Limits the whole process to a number of threads while it lives; 0 means all that the machine has.
class ThreadLimit {
  public:
    explicit ThreadLimit(std::size_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Limit;
    std::unique_ptr<Limit> limit_;
};

/// How many threads parallel loops use at present.
std::size_t thread_count();

/// Where arrays that may not fit into memory are kept.
struct ScratchOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< an array of more bytes than this lies in a file
    std::filesystem::path folder;               ///< in which the file is made; empty: nowhere, such an array is refused
};

}  // namespace hogel
