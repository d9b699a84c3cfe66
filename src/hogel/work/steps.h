// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>

#include "hogel/progress.h"

namespace hogel::work {

/// Reports the progress of a number of equal steps that finish in any order. Thread-safe.
class Steps {
  public:
    Steps(const Progress& progress, std::size_t count) : progress_(progress), count_(count) {}

    void report_one() {
        const std::lock_guard lock(mutex_);
        progress_.report(static_cast<double>(++done_) / static_cast<double>(count_));
    }

  private:
    const Progress& progress_;
    std::size_t count_, done_ = 0;
    std::mutex mutex_;
};

}  // namespace hogel::work
