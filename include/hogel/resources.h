// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "hogel/export.h"

namespace hogel {

/// Limits the number of threads of all parallel loops in this process while the object exists. 0: no limit.
class HOGEL_API ThreadLimit {
  public:
    explicit ThreadLimit(std::size_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Limit;
    std::unique_ptr<Limit> limit_;
};

/// Returns the number of threads of parallel loops: all of the machine, or fewer under a ThreadLimit.
HOGEL_API std::size_t thread_count();

/// Sets the number of bytes of freed large arrays that are kept for reuse; 1 GiB by default. Reuse saves time because
/// the system clears every new page. Memory in use and kept memory together never exceed the earlier peak of memory in
/// use. A program that exits after its work can keep all of it; a long-lived program should keep little.
HOGEL_API void set_max_kept_memory(std::size_t bytes);

/// Memory limit and folder for large work arrays.
struct ScratchOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< bytes; a larger array is stored in a file
    std::filesystem::path folder;  ///< folder of that file; empty: an array that needs a file throws Error(usage)
};

/// Estimated resources of an operation.
struct Plan {
    double memory = 0;   ///< peak memory, bytes
    double disk = 0;     ///< size of the output files, bytes
    double seconds = 0;  ///< wall time on thread_count() threads; 0: no estimate
};

}  // namespace hogel
