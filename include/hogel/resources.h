// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "hogel/export.h"

namespace hogel {

/// While this object exists, the parallel loops of the whole process use at most this number of threads; 0: no limit.
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

/// The number of threads that parallel loops use at present: all of the machine, or fewer under a ThreadLimit.
HOGEL_API std::size_t thread_count();

/// Sets how many bytes of large arrays are kept when they are freed, for later ones, because the system clears every
/// new page; 1 GiB unless set. Arrays in use and memory that is kept are together never more than was in use before. A
/// program that ends after its work may keep all of it; one that lives long gives back the rest at once.
HOGEL_API void set_max_kept_memory(std::size_t bytes);

/// Where to keep large arrays that may not fit into memory.
struct ScratchOptions {
    std::size_t memory = std::size_t{2} << 30;  ///< an array of more bytes than this is kept in a file
    std::filesystem::path folder;  ///< of that file; if empty, an array that needs a file throws Error(usage)
};

/// Estimated resources of work.
struct Plan {
    double memory = 0;   ///< maximum of bytes held at any time
    double disk = 0;     ///< bytes of the output files
    double seconds = 0;  ///< wall time on thread_count() threads; 0 where there is no estimate
};

}  // namespace hogel
